// Functions in CasADi's C, compiled with them for the processor that PEERS_PROGRAM names.

#include "subjects.hpp"
#include "trees.hpp"

extern "C" {
#define DECLARE(name) int name(const double ** arg, double ** res, long long * iw, double * w, int mem);
DECLARE(puma560_inverse)
DECLARE(puma560_mass)
DECLARE(puma560_forward)
DECLARE(panda_inverse)
DECLARE(panda_mass)
DECLARE(panda_forward)
DECLARE(panda_derivatives)
DECLARE(four_legged_forward)
DECLARE(four_legged_derivatives)
DECLARE(humanoid_forward)
DECLARE(humanoid_mass)
}

using Compiled = decltype(panda_forward);

// What a function takes of a state.
enum class Takes
{
  Accelerations,
  Positions,
  Torques
};

template<typename Robot, Compiled * compiled, Takes takes, int matrices, int columns>
struct Function : State<Robot>
{
  using Base = State<Robot>;
  static constexpr int rows = Base::dof, size = rows * columns;
  std::vector<double> values;
  // CasADi's generated functions of expressions need no work vectors beyond their variables.
  explicit Function(const double * numbers)
  : Base(numbers)
  , values(matrices * rows * rows)
  {
  }
  void evaluate()
  {
    const double * arg[3] = {Base::q, Base::v, takes == Takes::Accelerations ? Base::a : Base::torque};
    double * res[3] = {values.data(), values.data() + rows * columns, values.data() + 2 * rows * columns};
    compiled(arg, res, nullptr, nullptr, 0);
  }
  std::size_t results(double * to) const
  {
    const std::size_t count = rows * columns + (matrices == 3 ? rows * columns + rows * Robot::joints : 0);
    for (std::size_t k = 0; k < count; ++k)
      to[k] = values[k];
    return count;
  }
};

template<typename Robot, Compiled * compiled>
using Inverse = Function<Robot, compiled, Takes::Accelerations, 1, 1>;
template<typename Robot, Compiled * compiled>
using Forward = Function<Robot, compiled, Takes::Torques, 1, 1>;
template<typename Robot, Compiled * compiled>
using Mass = Function<Robot, compiled, Takes::Positions, 1, State<Robot>::dof>;
template<typename Robot, Compiled * compiled>
using Derivatives = Function<Robot, compiled, Takes::Torques, 3, State<Robot>::dof>;

extern "C" const Subject * peers_subjects(std::size_t * count)
{
  const char * program = PEERS_PROGRAM;
  static const std::vector<Subject> all = {
    subject<Inverse<Puma, puma560_inverse>>("puma560", "inverse", program),
    subject<Mass<Puma, puma560_mass>>("puma560", "mass", program),
    subject<Forward<Puma, puma560_forward>>("puma560", "forward", program),
    subject<Inverse<Panda, panda_inverse>>("panda", "inverse", program),
    subject<Mass<Panda, panda_mass>>("panda", "mass", program),
    subject<Forward<Panda, panda_forward>>("panda", "forward", program),
    subject<Derivatives<Panda, panda_derivatives>>("panda", "derivatives", program),
    subject<Forward<FourLegged, four_legged_forward>>("four_legged", "forward", program),
    subject<Derivatives<FourLegged, four_legged_derivatives>>("four_legged", "derivatives", program),
    subject<Forward<Humanoid, humanoid_forward>>("humanoid", "forward", program),
    subject<Mass<Humanoid, humanoid_mass>>("humanoid", "mass", program),
  };
  return exported(all, count);
}
