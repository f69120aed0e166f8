// CasADi's C of the panda's forward dynamics, compiled for a lane of four: gcc's vectors in the place of its scalar.

#include <algorithm>

#include "subjects.hpp"
#include "trees.hpp"

typedef double Four __attribute__((vector_size(32)));
typedef long long Whole __attribute__((vector_size(32)));

// Where C converts a literal to a scalar this fills a lane.
struct Lanes
{
  Four all;
  Lanes() = default;
  Lanes(double value)
  : all{value, value, value, value}
  {
  }
  Lanes(Four values)
  : all(values)
  {
  }
  Lanes & operator+=(Lanes other)
  {
    all += other.all;
    return *this;
  }
};

static inline Lanes operator+(Lanes a, Lanes b)
{
  return a.all + b.all;
}
static inline Lanes operator-(Lanes a, Lanes b)
{
  return a.all - b.all;
}
static inline Lanes operator*(Lanes a, Lanes b)
{
  return a.all * b.all;
}
static inline Lanes operator/(Lanes a, Lanes b)
{
  return a.all / b.all;
}
static inline Lanes operator-(Lanes a)
{
  return -a.all;
}

// An angle as a whole number of quarter turns, and the rest with its sine and cosine, by their series: to the last digit but
// one for angles of some thousand turns. Both are computed, and where both are asked for, they are computed once.
struct Quarter
{
  Four sine, cosine;
  Whole turns;
};

static inline Quarter quarter(Four x)
{
  // A quarter turn in three parts, of which the first two have few enough digits for their products to be exact.
  constexpr double first = 0x1.921fb54400000p+0, second = 0x1.0b4611a600000p-34, third = 0x1.3198a2e037073p-69;
  // Added and subtracted it rounds to whole numbers, and its lowest bits hold them meanwhile.
  constexpr double rounding = 0x1.8p52;
  const Four shifted = x * 0x1.45f306dc9c883p-1 + rounding;
  const Four count = shifted - rounding;
  const Four r = ((x - count * first) - count * second) - count * third, s = r * r;
  const Four sine =
    r + r * s
          * (-1.0 / 6
             + s
                 * (1.0 / 120
                    + s
                        * (-1.0 / 5040
                           + s * (1.0 / 362880 + s * (-1.0 / 39916800 + s * (1.0 / 6227020800 - s / 1307674368000))))));
  const Four cosine =
    1.0 - 0.5 * s
    + s * s
        * (1.0 / 24
           + s
               * (-1.0 / 720
                  + s
                      * (1.0 / 40320
                         + s * (-1.0 / 3628800 + s * (1.0 / 479001600 + s * (-1.0 / 87178291200 + s / 20922789888000))))));
  return {sine, cosine, (Whole)shifted};
}

// With an odd number of quarter turns the two change places, and the second bit is the sign. A cosine is the sine of an angle
// with one quarter turn more.
static inline Lanes chosen(Four even, Four odd, Whole turns)
{
  const Whole sign = (turns & 2) << 62;
  return (Four)((Whole)((turns & 1) != 0 ? odd : even) ^ sign);
}

static inline Lanes sin(Lanes x)
{
  const Quarter q = quarter(x.all);
  return chosen(q.sine, q.cosine, q.turns);
}

static inline Lanes cos(Lanes x)
{
  const Quarter q = quarter(x.all);
  return chosen(q.sine, q.cosine, q.turns + 1);
}

#define casadi_real Lanes
#define casadi_int long long int
#include "panda_forward.c"

struct Forward
{
  static constexpr int dof = State<Panda>::dof;
  Lanes q[dof], v[dof], torque[dof], results[dof];

  void evaluate()
  {
    const Lanes * arg[3] = {q, v, torque};
    Lanes * res[1] = {results};
    panda_forward(arg, res, nullptr, nullptr, 0);
  }
};

// Aligned as vectors have to be.
static std::vector<Forward> functions;

static void load(const double * states, std::size_t count)
{
  const std::size_t length = State<Panda>::length();
  functions.resize(count / 4);
  for (std::size_t state = 0; state < count; ++state)
  {
    Forward & function = functions[state / 4];
    const State<Panda> numbers(states + state * length);
    for (int k = 0; k < Forward::dof; ++k)
    {
      function.q[k].all[state % 4] = numbers.q[k];
      function.v[k].all[state % 4] = numbers.v[k];
      function.torque[k].all[state % 4] = numbers.torque[k];
    }
  }
}

static std::size_t evaluate(std::size_t state, double * results)
{
  Forward & function = functions[state / 4];
  function.evaluate();
  std::transform(
    function.results, function.results + Forward::dof, results, [&](Lanes value) { return value.all[state % 4]; });
  return Forward::dof;
}

static void run(std::size_t count)
{
  std::size_t k = 0;
  for (std::size_t i = 0; i < count / 4; ++i)
  {
    functions[k].evaluate();
    asm volatile("" : : : "memory");
    k = k + 1 == functions.size() ? 0 : k + 1;
  }
}

extern "C" const Subject * peers_subjects(std::size_t * count)
{
  static const std::vector<Subject> all = {
    {"panda", "forward, lanes of four", PEERS_PROGRAM, 1e-11, load, evaluate, run},
  };
  return exported(all, count);
}
