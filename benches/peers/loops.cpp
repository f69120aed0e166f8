// Forward dynamics of mechanisms with closed loops by Pinocchio's algorithms.

#include "loops.hpp"
#include "pinocchio/algorithm/constrained-dynamics.hpp"
#include "pinocchio/algorithm/loop-constrained-aba.hpp"
#include "subjects.hpp"

using pinocchio::Data;
using pinocchio::ProximalSettings;
using Column = Eigen::VectorXd;
using Closed = std::vector<pinocchio::RigidConstraintData>;

// `mu` is Pinocchio's default where all equations are independent, else what its documentation says for redundant ones.
struct Stewart
{
  static constexpr double mu = 0;
  static Mechanism make()
  {
    return stewart();
  }
};
struct Delta
{
  static constexpr double mu = 0;
  static Mechanism make()
  {
    return delta();
  }
};
struct Biped
{
  static constexpr double mu = 1e-12;
  static Mechanism make()
  {
    return biped();
  }
};

template<typename Kind>
struct Prepared
{
  Column q, v, effort, accel;

  static Mechanism & all()
  {
    static Mechanism made = Kind::make();
    return made;
  }

  static Closed & closed()
  {
    static Closed made(all().closures.begin(), all().closures.end());
    return made;
  }

  static std::size_t length()
  {
    return all().model.nq + 3 * all().model.nv;
  }

  explicit Prepared(const double * numbers)
  {
    const auto take = [&](int size) {
      const Column column = Eigen::Map<const Column>(numbers, size);
      numbers += size;
      return column;
    };
    q = take(all().model.nq);
    v = take(all().model.nv);
    take(all().model.nv);
    effort = take(all().model.nv);
    accel = Column::Zero(all().model.nv);
  }

  std::size_t results(double * to) const
  {
    Eigen::Map<Column>(to, accel.size()) = accel;
    return accel.size();
  }
};

template<typename Kind>
struct Dense : Prepared<Kind>
{
  using Prepared<Kind>::Prepared;

  static Data & data()
  {
    static Data made = [] {
      Data data(Prepared<Kind>::all().model);
      pinocchio::initConstraintDynamics(
        Prepared<Kind>::all().model, data, Prepared<Kind>::all().closures, Prepared<Kind>::closed());
      return data;
    }();
    return made;
  }

  void evaluate()
  {
    static ProximalSettings once = [] {
      ProximalSettings settings;
      settings.mu = Kind::mu;
      return settings;
    }();
    this->accel = pinocchio::constraintDynamics(
      this->all().model, data(), this->q, this->v, this->effort, this->all().closures, this->closed(), once);
  }
};

// With the cheapest setting of those tried (1e-1 to 1e-10, one to eight iterations) that keeps nine digits everywhere.
template<typename Kind>
struct Proximal : Prepared<Kind>
{
  using Prepared<Kind>::Prepared;

  static Data & data()
  {
    static Data made = [] {
      Data data(Prepared<Kind>::all().model);
      pinocchio::computeJointMinimalOrdering(Prepared<Kind>::all().model, data, Prepared<Kind>::all().closures);
      return data;
    }();
    return made;
  }

  void evaluate()
  {
    static ProximalSettings penalty(1e-14, 1e-3, 3);
    this->accel = pinocchio::lcaba(
      this->all().model, data(), this->q, this->v, this->effort, this->all().closures, this->closed(), penalty);
  }
};

extern "C" const Subject * peers_subjects(std::size_t * count)
{
  const char *dense = "Pinocchio, constraintDynamics", *proximal = "Pinocchio, lcaba";
  // `lcaba` approaches the equations by iterations; what is redundant in the biped's costs `constraintDynamics` digits too.
  static const std::vector<Subject> all = {
    subject<Dense<Stewart>>("stewart", "forward", dense),
    subject<Proximal<Stewart>>("stewart", "forward", proximal, 1e-9),
    subject<Dense<Delta>>("delta", "forward", dense),
    subject<Proximal<Delta>>("delta", "forward", proximal, 1e-9),
    subject<Dense<Biped>>("biped", "forward", dense, 1e-9),
    subject<Proximal<Biped>>("biped", "forward", proximal, 1e-9),
  };
  return exported(all, count);
}
