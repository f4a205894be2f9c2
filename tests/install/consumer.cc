// A project of somebody else: one boundary-value problem without a scene, solved on both sides.

#include <analysis/statics.h>
#include <meshfree/method.h>
#include <problem/builder.h>
#include <reference/method.h>

#include <cmath>
#include <iostream>

int main()
{
  using namespace plumbline;
  const double h = .05, horizon = .15;
  problem::ProblemBuilder given(
      problem::LatticeDomain{{{{{{0, 0}, {1, 1}}}, {}}, h}},
      physics::Kernel<2>::with_diffusion(physics::kernel_type("constant").profile, horizon, 1));
  given.load.value = [](const dealii::Point<2> &x, unsigned int) { return 10 * x[0]; };
  const problem::Problem<2> problem = given.build(); // u = 0 around the square

  const auto solve = [&](const method::Methods &methods, const std::string &name)
  {
    for (const auto &method : methods)
      if (method->name() == name)
        return analysis::solve(*method, problem).averages;
    throw std::runtime_error("no " + name);
  };
  const auto exact = solve(reference::methods(), "Q2"), rule = solve(meshfree::methods(), "IPA-AC");
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    error = std::max(error, std::abs(rule[i] - exact[i]));
    largest = std::max(largest, exact[i]);
  }
  std::cout << "IPA-AC differs from Q2 by " << error / largest << " of the largest u\n";
  return error < .1 * largest && error > 0 ? 0 : 1;
}
