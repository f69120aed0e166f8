// Subjects of `subject.h` out of classes.
#pragma once

#include <cstddef>
#include <vector>

#include "subject.h"


// `Function` has the names of `robot` and `function`, the length of a state, and of a state: `Function(const double *)`,
// `evaluate()`, which is timed, and `results(double *)`.
template<typename Function>
struct Subjects
{
  static inline std::vector<Function> functions;

  static void load(const double * states, std::size_t count)
  {
    for (std::size_t k = 0; k < count; ++k)
      functions.emplace_back(states + k * Function::length());
  }

  static std::size_t evaluate(std::size_t state, double * results)
  {
    functions[state].evaluate();
    return functions[state].results(results);
  }

  static void run(std::size_t count)
  {
    std::size_t k = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      functions[k].evaluate();
      asm volatile("" : : : "memory");
      k = k + 1 == functions.size() ? 0 : k + 1;
    }
  }
};

template<typename Function>
Subject subject(const char * robot, const char * function, const char * program, double tolerance = 1e-11)
{
  using All = Subjects<Function>;
  return {robot, function, program, tolerance, All::load, All::evaluate, All::run};
}

// The export of a library.
inline const Subject * exported(const std::vector<Subject> & subjects, std::size_t * count)
{
  *count = subjects.size();
  return subjects.data();
}
