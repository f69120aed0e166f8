// A robot of `robots.py`, and the same as a model of Pinocchio.
#pragma once

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "pinocchio/multibody.hpp"
#include "pinocchio/multibody/joint.hpp"

struct Link
{
  int parent;
  std::string kind;
  Eigen::Vector3d axis, place, com;
  Eigen::Matrix3d turn;
  double mass;
  Eigen::Matrix3d inertia;
};

struct Robot
{
  std::string name;
  Eigen::Vector3d gravity;
  std::vector<Link> links;

  bool floats() const
  {
    return links.front().kind == "free";
  }

  // Where efforts of joints begin: those of a floating base are zero.
  int driven() const
  {
    return floats() ? 6 : 0;
  }
};

inline Robot read_robot(const std::string & path)
{
  std::ifstream file(path);
  Robot robot;
  std::size_t count = 0;
  const auto vector = [&] {
    double x = 0, y = 0, z = 0;
    file >> x >> y >> z;
    return Eigen::Vector3d(x, y, z);
  };
  file >> robot.name >> count;
  robot.gravity = vector();
  for (std::size_t k = 0; k < count; ++k)
  {
    Link link;
    file >> link.parent >> link.kind;
    link.axis = vector();
    for (int row = 0; row < 3; ++row)
      link.turn.row(row) = vector();
    link.place = vector();
    file >> link.mass;
    link.com = vector();
    const Eigen::Vector3d squares = vector(), products = vector();
    link.inertia << squares.x(), products.x(), products.y(), products.x(), squares.y(), products.z(), products.y(),
      products.z(), squares.z();
    robot.links.push_back(link);
  }
  if (!file)
    throw std::runtime_error("`" + path + "` is no robot");
  return robot;
}

inline pinocchio::Model pinocchio_model(const Robot & robot)
{
  using namespace pinocchio;
  Model model;
  model.gravity.linear() = robot.gravity;
  for (std::size_t k = 0; k < robot.links.size(); ++k)
  {
    const Link & link = robot.links[k];
    const SE3 placement(link.turn, link.place);
    const std::string name = "joint" + std::to_string(k);
    const JointIndex parent = link.parent + 1;
    JointIndex id = 0;
    const auto add = [&](const auto & joint) { id = model.addJoint(parent, joint, placement, name); };
    const bool turns = link.kind == "revolute";
    if (link.kind == "free")
      add(JointModelFreeFlyer());
    else if (turns && link.axis == Eigen::Vector3d::UnitX())
      add(JointModelRX());
    else if (turns && link.axis == Eigen::Vector3d::UnitY())
      add(JointModelRY());
    else if (turns && link.axis == Eigen::Vector3d::UnitZ())
      add(JointModelRZ());
    else if (turns)
      add(JointModelRevoluteUnaligned(link.axis));
    else
      add(JointModelPrismaticUnaligned(link.axis));
    model.appendBodyToJoint(id, Inertia(link.mass, link.com, Symmetric3(link.inertia)), SE3::Identity());
  }
  return model;
}
