// Forward dynamics of the mechanisms of models.hpp by Pinocchio's algorithms.
//
// `main STATES` reads the states and accelerations that the Rust program has written, demands that every algorithm gives
// these accelerations, and prints a line for each: mechanism, algorithm, [ns] least time of an evaluation.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "models.hpp"
#include "pinocchio/algorithm/constrained-dynamics.hpp"
#include "pinocchio/algorithm/loop-constrained-aba.hpp"

using pinocchio::Data;
using pinocchio::ProximalSettings;
using Column = Eigen::VectorXd;
using Closed = std::vector<pinocchio::RigidConstraintData>;

struct Sample
{
  Column q, v, effort, accel;
};

// A mechanism's name, its number of states, and of each state positions, velocities, efforts and accelerations.
static std::vector<Sample> read(std::istream & file, const pinocchio::Model & model, const std::string & expected)
{
  std::string name;
  std::size_t count = 0;
  file >> name >> count;
  if (name != expected)
    throw std::runtime_error("states of `" + expected + "` expected, found `" + name + "`");
  std::vector<Sample> samples(count);
  for (Sample & sample : samples)
  {
    sample = {Column(model.nq), Column(model.nv), Column(model.nv), Column(model.nv)};
    for (Column * column : {&sample.q, &sample.v, &sample.effort, &sample.accel})
      for (double & value : *column)
        file >> value;
  }
  if (!file)
    throw std::runtime_error("the states of `" + expected + "` are incomplete");
  return samples;
}

// [ns] how long this thread has been ready to run and did not, where the system tells (Linux): time of others.
static double waited()
{
  std::ifstream file("/proc/self/schedstat");
  double ran = 0, waited = 0;
  file >> ran >> waited;
  return waited;
}

// Demands the accelerations up to `bound`, relative to the greatest, before it looks at the clock.
template<typename Evaluate>
static void
measure(const char * name, const char * algorithm, double bound, const std::vector<Sample> & samples, Evaluate evaluate)
{
  double worst = 0;
  for (const Sample & sample : samples)
  {
    const Column difference = evaluate(sample) - sample.accel;
    const double error = difference.lpNorm<Eigen::Infinity>() / sample.accel.lpNorm<Eigen::Infinity>();
    if (!(error <= bound))
    {
      std::fprintf(stderr, "%s, %s: accelerations differ by %.1e\n", name, algorithm, error);
      std::exit(1);
    }
    worst = std::max(worst, error);
  }
  constexpr int evaluations = 10'000, runs = 20;
  double least = std::numeric_limits<double>::infinity();
  double sum = 0;
  for (int run = 0; run < runs; ++run)
  {
    const auto start = std::chrono::steady_clock::now();
    const double before = waited();
    for (int k = 0; k < evaluations; ++k)
      sum += evaluate(samples[k % samples.size()])[0];
    const double lost = waited() - before;
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    least = std::min(least, (time.count() - lost) / evaluations);
  }
  if (std::isnan(sum))
    throw std::runtime_error("accelerations are not numbers");
  std::printf("%s %s %.1f %.1e\n", name, algorithm, least, worst);
}

// `mu` is Pinocchio's default where all equations are independent, else what its documentation says for redundant ones.
static void compare(std::istream & file, const char * name, const Mechanism & all, double mu)
{
  const std::vector<Sample> samples = read(file, all.model, name);
  Closed closed;
  for (const auto & closure : all.closures)
    closed.emplace_back(closure);

  Data data(all.model);
  pinocchio::initConstraintDynamics(all.model, data, all.closures, closed);
  ProximalSettings once;
  once.mu = mu;
  measure(name, "constraintDynamics", 1e-9, samples, [&](const Sample & sample) -> const Column & {
    return pinocchio::constraintDynamics(
      all.model, data, sample.q, sample.v, sample.effort, all.closures, closed, once);
  });

  // The cheapest setting of those tried (1e-1 to 1e-10, one to eight iterations) that keeps nine digits everywhere.
  Data loops(all.model);
  pinocchio::computeJointMinimalOrdering(all.model, loops, all.closures);
  ProximalSettings penalty(1e-14, 1e-3, 3);
  measure(name, "lcaba", 1e-9, samples, [&](const Sample & sample) -> const Column & {
    return pinocchio::lcaba(all.model, loops, sample.q, sample.v, sample.effort, all.closures, closed, penalty);
  });
}

int main(int count, char ** arguments)
{
  if (count != 2)
    return std::fprintf(stderr, "usage: main STATES\n"), 2;
  std::ifstream file(arguments[1]);
  try
  {
    compare(file, "stewart", stewart(), 0);
    compare(file, "delta", delta(), 0);
    compare(file, "biped", biped(), 1e-12);
  }
  catch (const std::exception & error)
  {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}
