// Writes C of CasADi for a robot: Pinocchio's algorithms on CasADi's expressions, common subexpressions removed.
//
// `codegen ROBOT OUT` writes OUT/NAME_FUNCTION.c and prints how many operations each function takes.

#include <cstdio>
#include <filesystem>

#include "pinocchio/autodiff/casadi.hpp"

#include "robot.hpp"
#include "pinocchio/algorithm/aba-derivatives.hpp"
#include "pinocchio/algorithm/aba.hpp"
#include "pinocchio/algorithm/crba.hpp"
#include "pinocchio/algorithm/rnea.hpp"

using Expression = casadi::SX;
using Model = pinocchio::ModelTpl<Expression>;
using Data = pinocchio::DataTpl<Expression>;
using Column = Model::ConfigVectorType;
using Matrix = Data::MatrixXs;

static Column column(const Expression & values)
{
  Column result(values.size1());
  for (casadi_int k = 0; k < values.size1(); ++k)
    result[k] = values(k);
  return result;
}

template<typename Dense>
static Expression dense(const Dense & values)
{
  Expression result(casadi::Sparsity::dense(values.rows(), values.cols()));
  for (Eigen::Index row = 0; row < values.rows(); ++row)
    for (Eigen::Index col = 0; col < values.cols(); ++col)
      result(row, col) = values(row, col);
  return result;
}

// Operations of a function's instructions, inputs, outputs and literals aside; signs are none.
static void count(const casadi::Function & function)
{
  int sums = 0, products = 0, quotients = 0, others = 0;
  for (casadi_int k = 0; k < function.n_instructions(); ++k)
    switch (function.instruction_id(k))
    {
    case casadi::OP_ADD:
    case casadi::OP_SUB:
      ++sums;
      break;
    case casadi::OP_MUL:
    case casadi::OP_SQ:
    case casadi::OP_TWICE:
      ++products;
      break;
    case casadi::OP_DIV:
    case casadi::OP_INV:
      ++quotients;
      break;
    case casadi::OP_INPUT:
    case casadi::OP_OUTPUT:
    case casadi::OP_CONST:
    case casadi::OP_NEG:
      break;
    default:
      ++others;
    }
  std::printf("%s %d/%d/%d, %d others\n", function.name().c_str(), sums, products, quotients, others);
}

static void write(
  const std::string & robot, const std::string & name, const std::vector<Expression> & inputs,
  const std::vector<Expression> & results)
{
  const casadi::Function function(robot + "_" + name, inputs, Expression::cse(results));
  count(function);
  function.generate(function.name() + ".c");
}

int main(int words, char ** arguments)
{
  if (words != 3)
    return std::fprintf(stderr, "usage: codegen ROBOT OUT\n"), 2;
  const Robot robot = read_robot(arguments[1]);
  std::filesystem::current_path(arguments[2]);
  const Model model = pinocchio_model(robot).cast<Expression>();
  const Expression q = Expression::sym("q", model.nq), v = Expression::sym("v", model.nv);
  const Expression a = Expression::sym("a", model.nv), torque = Expression::sym("torque", model.nv - robot.driven());
  const Expression effort = vertcat(Expression::zeros(robot.driven()), torque);
  {
    Data data(model);
    const Column & result = pinocchio::rnea(model, data, column(q), column(v), column(a));
    write(robot.name, "inverse", {q, v, a}, {dense(result)});
  }
  {
    Data data(model);
    pinocchio::aba(model, data, column(q), column(v), column(effort), pinocchio::Convention::LOCAL);
    write(robot.name, "forward", {q, v, torque}, {dense(data.ddq)});
  }
  {
    Data data(model);
    pinocchio::crba(model, data, column(q), pinocchio::Convention::LOCAL);
    data.M.triangularView<Eigen::StrictlyLower>() = data.M.transpose().triangularView<Eigen::StrictlyLower>();
    write(robot.name, "mass", {q}, {dense(data.M)});
  }
  {
    Data data(model);
    pinocchio::computeABADerivatives(model, data, column(q), column(v), column(effort));
    data.Minv.triangularView<Eigen::StrictlyLower>() = data.Minv.transpose().triangularView<Eigen::StrictlyLower>();
    const Expression by_effort = dense(data.Minv)(casadi::Slice(), casadi::Slice(robot.driven(), model.nv));
    write(robot.name, "derivatives", {q, v, torque}, {dense(data.ddq_dq), dense(data.ddq_dv), by_effort});
  }
}
