// The mechanisms of models.rs as trees of joints and closures by points. The order of joints is that of states.rs.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "pinocchio/multibody.hpp"
#include "pinocchio/multibody/joint.hpp"
#include "pinocchio/constraints.hpp"

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;
using pinocchio::Inertia;
using pinocchio::JointIndex;
using pinocchio::SE3;
using Closures = std::vector<pinocchio::RigidConstraintModel>;

struct Mechanism
{
  pinocchio::Model model;
  Closures closures;

  explicit Mechanism(double gravity)
  {
    model.gravity.linear() = Vector(0, 0, -gravity);
  }

  // A joint with a body; a body of mass zero is left out.
  template<typename Joint>
  JointIndex add(JointIndex parent, const Joint & joint, const SE3 & placement, const Inertia & body = Inertia::Zero())
  {
    const JointIndex id = model.addJoint(parent, joint, placement, "joint" + std::to_string(model.njoints));
    model.appendBodyToJoint(id, body, SE3::Identity());
    return id;
  }

  // The point of one body that stays at the point of another.
  void close(JointIndex first, const Vector & at_first, JointIndex second, const Vector & at_second)
  {
    closures.emplace_back(
      pinocchio::CONTACT_3D, model, first, SE3(Matrix::Identity(), at_first), second,
      SE3(Matrix::Identity(), at_second), pinocchio::LOCAL);
  }
};

inline SE3 at(double x, double y, double z)
{
  return SE3(Matrix::Identity(), Vector(x, y, z));
}

// The inertia about the centre of mass: xx, yy, zz, xy, xz, yz.
inline Inertia body(double mass, const Vector & com, const std::array<double, 6> & i)
{
  Matrix inertia;
  inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return Inertia(mass, com, pinocchio::Symmetric3(inertia));
}

inline Inertia body(double mass, const Vector & com, double xx, double yy, double zz)
{
  return body(mass, com, {xx, yy, zz, 0, 0, 0});
}

inline Matrix about_z(double angle)
{
  return Eigen::AngleAxisd(angle, Vector::UnitZ()).toRotationMatrix();
}

inline Mechanism stewart()
{
  using namespace pinocchio;
  const double feet[6][2] = {{-2.12, 1.374}, {-2.38, 1.224}, {-2.38, -1.224}, {-2.12, -1.374}, {0, -0.15}, {0, 0.15}};
  const double pins[6][2] = {{0.17, 0.595}, {-0.6, 0.15}, {-0.6, -0.15}, {0.17, -0.595}, {0.43, -0.445}, {0.43, 0.445}};
  const double heading[6] = {-0.75, -0.55, 0.55, 0.75, -2.85, 2.85};
  Mechanism all(9.80665);
  const JointIndex platform =
    all.add(0, JointModelFreeFlyer(), SE3::Identity(), body(1.5, Vector::Zero(), 0.08, 0.08, 0.08));
  JointIndex pistons[6];
  for (int i = 0; i < 6; ++i)
  {
    const SE3 foot(about_z(heading[i]), Vector(feet[i][0], feet[i][1], 0));
    // Faster than two revolute joints: by a sixth with `lcaba`.
    const JointModelUniversal gimbal(Vector::UnitX(), Vector::UnitY());
    const JointIndex cylinder = all.add(0, gimbal, foot, body(0.1, Vector(0, 0, 0.5), 0.00625, 0.00625, 0));
    pistons[i] = all.add(cylinder, JointModelPZ(), at(0, 0, 1), body(0.1, Vector(0, 0, -0.5), 0.00625, 0.00625, 0));
  }
  for (int i = 0; i < 6; ++i)
    all.close(pistons[i], Vector::Zero(), platform, Vector(pins[i][0], pins[i][1], -0.4));
  return all;
}

inline Mechanism delta()
{
  using namespace pinocchio;
  Mechanism all(9.80665);
  const JointIndex plate =
    all.add(0, JointModelFreeFlyer(), SE3::Identity(), body(0.5, Vector::Zero(), 0.001, 0.001, 0.002));
  struct Rod
  {
    JointIndex id;
    Vector pin;
  };
  std::vector<Rod> rods;
  for (int i = 0; i < 3; ++i)
  {
    const Matrix turned = about_z(i * 2.0 * M_PI / 3.0);
    const JointIndex arm = all.add(
      0, JointModelRY(), SE3(turned, turned * Vector(0.2, 0, 0)), body(0.3, Vector(0.15, 0, 0), 0.0001, 0.003, 0.003));
    for (const double side : {0.05, -0.05})
    {
      const JointModelUniversal elbow(Vector::UnitY(), Vector::UnitZ());
      const JointIndex rod =
        all.add(arm, elbow, at(0.3, side, 0), body(0.1, Vector(0.4, 0, 0), 0.00001, 0.006, 0.006));
      rods.push_back({rod, turned * Vector(0.05, side, 0)});
    }
  }
  for (const Rod & rod : rods)
    all.close(rod.id, Vector(0.8, 0, 0), plate, rod.pin);
  return all;
}

// Of a planar linkage that is closed by a point, one of the three equations says nothing.
inline Mechanism biped()
{
  using namespace pinocchio;
  Mechanism all(9.80665);
  const JointIndex pelvis = all.add(
    0, JointModelFreeFlyer(), SE3::Identity(),
    body(12.0, Vector(0.01, 0, 0.12), {0.21, 0.17, 0.13, 0.002, -0.006, 0.001}));
  struct Linkage
  {
    JointIndex rod, foot;
  };
  std::vector<Linkage> linkages;
  for (const double side : {0.1, -0.1})
  {
    const JointIndex yoke = all.add(
      pelvis, JointModelRZ(), at(0, side, -0.05), body(0.8, Vector(0.01, 0, -0.02), 0.002, 0.0021, 0.0015));
    const JointIndex fork =
      all.add(yoke, JointModelRX(), at(0, 0, -0.05), body(0.9, Vector(-0.01, 0, 0), 0.0018, 0.002, 0.0022));
    const JointIndex thigh = all.add(
      fork, JointModelRY(), SE3::Identity(),
      body(4.0, Vector(0.005, 0.01, -0.17), {0.06, 0.062, 0.009, 0.0003, 0.0011, -0.0006}));
    const JointIndex shank = all.add(
      thigh, JointModelRY(), at(0, 0, -0.4),
      body(2.5, Vector(0.004, -0.002, -0.16), {0.035, 0.0355, 0.003, 0.0001, 0.0007, 0.0002}));
    const JointIndex crank =
      all.add(shank, JointModelRY(), at(-0.01, 0.03, -0.05), body(0.15, Vector(-0.02, 0, 0), 0.00002, 0.0001, 0.0001));
    const JointIndex rod =
      all.add(crank, JointModelRY(), at(-0.05, 0, 0), body(0.2, Vector(0, 0, -0.175), 0.002, 0.002, 0.00001));
    const JointIndex foot = all.add(
      shank, JointModelRY(), at(0, 0, -0.4), body(0.9, Vector(0.04, 0, -0.04), {0.0012, 0.004, 0.0042, 0, 0.0005, 0}));
    linkages.push_back({rod, foot});
  }
  for (const Linkage & each : linkages)
    all.close(each.rod, Vector(0, 0, -0.35), each.foot, Vector(-0.06, 0.03, 0));
  return all;
}
