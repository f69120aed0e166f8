// Pinocchio's algorithms on the robots of `robots.py`.

#include "pinocchio/algorithm/aba-derivatives.hpp"
#include "pinocchio/algorithm/aba.hpp"
#include "pinocchio/algorithm/crba.hpp"
#include "pinocchio/algorithm/rnea.hpp"
#include "robot.hpp"
#include "subjects.hpp"
#include "trees.hpp"

using Column = Eigen::VectorXd;

template<typename Robot>
struct Prepared
{
  static constexpr int dof = State<Robot>::dof, positions = State<Robot>::positions;
  Column q, v, a, effort;

  static std::size_t length()
  {
    return State<Robot>::length();
  }

  static const pinocchio::Model & model()
  {
    static const pinocchio::Model made = pinocchio_model(read_robot(robot_file(Robot::name, ".robot")));
    return made;
  }

  static pinocchio::Data & data()
  {
    static pinocchio::Data made(model());
    return made;
  }

  explicit Prepared(const double * numbers)
  {
    const State<Robot> state(numbers);
    q = Eigen::Map<const Column>(state.q, positions);
    v = Eigen::Map<const Column>(state.v, dof);
    a = Eigen::Map<const Column>(state.a, dof);
    effort = Eigen::Map<const Column>(state.effort, dof);
  }
};

template<typename Robot>
struct Inverse : Prepared<Robot>
{
  using Prepared<Robot>::Prepared;
  void evaluate()
  {
    pinocchio::rnea(this->model(), this->data(), this->q, this->v, this->a);
  }
  std::size_t results(double * to) const
  {
    Eigen::Map<Column>(to, this->dof) = this->data().tau;
    return this->dof;
  }
};

template<typename Robot>
struct Forward : Prepared<Robot>
{
  using Prepared<Robot>::Prepared;
  void evaluate()
  {
    pinocchio::aba(this->model(), this->data(), this->q, this->v, this->effort);
  }
  std::size_t results(double * to) const
  {
    Eigen::Map<Column>(to, this->dof) = this->data().ddq;
    return this->dof;
  }
};

// Its triangle above the diagonal is all that Pinocchio gives.
template<typename Robot>
struct Mass : Prepared<Robot>
{
  using Prepared<Robot>::Prepared;
  void evaluate()
  {
    pinocchio::crba(this->model(), this->data(), this->q);
  }
  std::size_t results(double * to) const
  {
    Eigen::Map<Eigen::MatrixXd>(to, this->dof, this->dof) =
      this->data().M.template selfadjointView<Eigen::Upper>();
    return this->dof * this->dof;
  }
};

template<typename Robot>
struct Derivatives : Prepared<Robot>
{
  using Prepared<Robot>::Prepared;
  void evaluate()
  {
    pinocchio::computeABADerivatives(this->model(), this->data(), this->q, this->v, this->effort);
  }
  std::size_t results(double * to) const
  {
    const int n = this->dof;
    const Eigen::MatrixXd inverse = this->data().Minv.template selfadjointView<Eigen::Upper>();
    Eigen::Map<Eigen::MatrixXd>(to, n, n) = this->data().ddq_dq;
    Eigen::Map<Eigen::MatrixXd>(to + n * n, n, n) = this->data().ddq_dv;
    Eigen::Map<Eigen::MatrixXd>(to + 2 * n * n, n, Robot::joints) = inverse.rightCols(Robot::joints);
    return n * (2 * n + Robot::joints);
  }
};

extern "C" const Subject * peers_subjects(std::size_t * count)
{
  const char * program = "Pinocchio";
  static const std::vector<Subject> all = {
    subject<Inverse<Puma>>("puma560", "inverse", program),
    subject<Mass<Puma>>("puma560", "mass", program),
    subject<Forward<Puma>>("puma560", "forward", program),
    subject<Inverse<Panda>>("panda", "inverse", program),
    subject<Mass<Panda>>("panda", "mass", program),
    subject<Forward<Panda>>("panda", "forward", program),
    subject<Derivatives<Panda>>("panda", "derivatives", program),
    subject<Forward<FourLegged>>("four_legged", "forward", program),
    subject<Derivatives<FourLegged>>("four_legged", "derivatives", program),
    subject<Forward<Humanoid>>("humanoid", "forward", program),
    subject<Mass<Humanoid>>("humanoid", "mass", program),
  };
  return exported(all, count);
}
