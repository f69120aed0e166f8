// MuJoCo's functions for dynamics alone, without contacts, sensors and constraints: the least that gives the results.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <mujoco/mujoco.h>

#include "subjects.hpp"
#include "trees.hpp"

// [x y z] of base axes to the ground's, by a unit quaternion with the real part first.
static void turn(const mjtNum * quaternion, const double * own, mjtNum * ground)
{
  mju_rotVecQuat(ground, own, quaternion);
}

template<typename Robot>
struct Simulated : State<Robot>
{
  using Base = State<Robot>;
  static constexpr int dof = Base::dof, positions = Base::positions;
  std::vector<mjtNum> qpos, qvel, qacc, values;

  static const mjModel * model()
  {
    static const mjModel * loaded = mj_loadModel(robot_file(Robot::name, ".mjb").c_str(), nullptr);
    if (!loaded || loaded->nv != dof || loaded->nq != positions)
      throw std::runtime_error("MuJoCo's model is another one");
    return loaded;
  }

  static mjData * data()
  {
    static mjData * made = mj_makeData(model());
    return made;
  }

  // A floating base has the quaternion's real part first, linear velocity and acceleration in the ground's axes.
  explicit Simulated(const double * numbers)
  : Base(numbers)
  , qpos(Base::q, Base::q + positions)
  , qvel(Base::v, Base::v + dof)
  , qacc(Base::a, Base::a + dof)
  , values(dof * dof)
  {
    if (Robot::base)
    {
      const mjtNum quaternion[4] = {Base::q[6], Base::q[3], Base::q[4], Base::q[5]};
      mju_copy(&qpos[3], quaternion, 4);
      turn(quaternion, Base::v, qvel.data());
      mjtNum carried[3];
      mju_cross(carried, Base::v + 3, Base::v);
      mju_addTo3(carried, Base::a);
      turn(quaternion, carried, qacc.data());
    }
  }

  void pose()
  {
    mju_copy(data()->qpos, qpos.data(), positions);
    mj_kinematics(model(), data());
    mj_comPos(model(), data());
  }

  void motion()
  {
    mju_copy(data()->qvel, qvel.data(), dof);
    mj_comVel(model(), data());
  }
};

template<typename Robot>
struct Inverse : Simulated<Robot>
{
  using Simulated<Robot>::Simulated;
  void evaluate()
  {
    this->pose();
    this->motion();
    mju_copy(this->data()->qacc, this->qacc.data(), this->dof);
    mj_rne(this->model(), this->data(), 1, this->values.data());
  }
  std::size_t results(double * to) const
  {
    std::copy_n(this->values.data(), this->dof, to);
    return this->dof;
  }
};

template<typename Robot>
struct Forward : Simulated<Robot>
{
  using Simulated<Robot>::Simulated;
  void evaluate()
  {
    this->pose();
    mj_makeM(this->model(), this->data());
    mj_factorM(this->model(), this->data());
    this->motion();
    mj_rne(this->model(), this->data(), 0, this->data()->qfrc_bias);
    mjtNum rest[State<Robot>::dof];
    mju_sub(rest, this->effort, this->data()->qfrc_bias, this->dof);
    mj_solveM(this->model(), this->data(), this->values.data(), rest, 1);
  }
  std::size_t results(double * to) const
  {
    std::copy_n(this->values.data(), this->dof, to);
    if (Robot::base)
    {
      mjtNum back[4];
      mju_negQuat(back, &this->qpos[3]);
      turn(back, this->values.data(), to);
      mjtNum carried[3];
      mju_cross(carried, this->v + 3, this->v);
      mju_subFrom3(to, carried);
    }
    return this->dof;
  }
};

template<typename Robot>
struct Mass : Simulated<Robot>
{
  using Simulated<Robot>::Simulated;
  void evaluate()
  {
    this->pose();
    mj_makeM(this->model(), this->data());
    mj_fullM(this->model(), this->data(), this->values.data());
  }
  // Columns, then rows of the base's linear velocity are turned to its own axes.
  std::size_t results(double * to) const
  {
    const int n = this->dof;
    std::copy_n(this->values.data(), n * n, to);
    if (Robot::base)
    {
      mjtNum back[4], old[3], own[3];
      mju_negQuat(back, &this->qpos[3]);
      for (const auto & [step, line] : {std::pair(1, n), std::pair(n, 1)})
        for (int k = 0; k < n; ++k)
        {
          for (int i = 0; i < 3; ++i)
            old[i] = to[k * line + i * step];
          turn(back, old, own);
          for (int i = 0; i < 3; ++i)
            to[k * line + i * step] = own[i];
        }
    }
    return n * n;
  }
};

extern "C" const Subject * peers_subjects(std::size_t * count)
{
  const char * program = "MuJoCo";
  static const std::vector<Subject> all = {
    subject<Inverse<Puma>>("puma560", "inverse", program),
    subject<Mass<Puma>>("puma560", "mass", program),
    subject<Forward<Puma>>("puma560", "forward", program),
    subject<Inverse<Panda>>("panda", "inverse", program),
    subject<Mass<Panda>>("panda", "mass", program),
    subject<Forward<Panda>>("panda", "forward", program),
    subject<Forward<FourLegged>>("four_legged", "forward", program),
    subject<Forward<Humanoid>>("humanoid", "forward", program),
    subject<Mass<Humanoid>>("humanoid", "mass", program),
  };
  return exported(all, count);
}
