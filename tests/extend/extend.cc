// A project of somebody else that adds a model, a folder, and a rule, a file, each with one row of
// a table; what the library does with its own it does with them: no file of it was touched.

#include "anisotropic/kernel.h"
#include "anisotropic/method.h"
#include "scene/problem.h"
#include "subcells/rule.h"

#include <analysis/statics.h>
#include <meshfree/method.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <iostream>

namespace
{
  using namespace plumbline;

  constexpr double a = .6; // of the fibres

  const std::vector<meshfree::Rule> my_rules = {
      {"SUB", "partial areas by counting parts of cells", subcells::rule}};

  method::Methods my_methods()
  {
    const auto &improved = meshfree::rules()[4]; // IPA-AC
    return {anisotropic::fibres(improved, a), anisotropic::fibres(improved, 0),
            anisotropic::fibres(my_rules[0], a), meshfree::make_method(improved),
            meshfree::make_method(my_rules[0])};
  }

  scene::Scene make_scene(const std::string &u, const std::string &load, const std::string &mesh)
  {
    return scene::parse_scene("extend.prm",
                              "subsection Domain\n set mesh = " + mesh +
                                  "\nend\nsubsection Problem\n set solution = " + u +
                                  "\n set load = " + load +
                                  "\nend\nsubsection Methods\n set names = FA\nend\n");
  }

  /// The largest error at a node.
  double error(const method::Method &method, const scene::Scene &scene, double h, double horizon)
  {
    const problem::Problem<2> problem = scene::make_problem(scene, 0, {h, horizon});
    const auto solution = analysis::solve(method, problem);
    double worst = 0;
    for (std::size_t i = 0; i < solution.nodes.size(); ++i)
      worst = std::max(worst,
                       std::abs(solution.nodal[i] - problem.solution->value(solution.nodes[i], 0)));
    return worst;
  }

  int n_failed = 0;

  void expect(const std::string &what, double found, double least, double most)
  {
    const bool holds = found >= least && found <= most;
    n_failed += holds ? 0 : 1;
    std::cout << (holds ? "  holds  " : "  FAILS  ") << what << ": " << found << " in [" << least
              << ", " << most << "]\n";
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const method::Methods methods = my_methods();
  const method::Method &fibres = *methods[0], &isotropic = *methods[1], &both = *methods[2],
                       &improved = *methods[3], &counted = *methods[4];

  // -½ Δ without fibres: with them ½ (1 ± a/2) along x and y
  const auto text = [](double value) { return std::to_string(value); };
  const double along = .5 * (1 + a / 2), across = .5 * (1 - a / 2);
  const physics::Kernel<2> kernel =
      physics::Kernel<2>::with_diffusion(physics::kernel_type("linear-decay").profile, .2, .5);
  const auto diffusion = anisotropic::FibreKernel(kernel, a).diffusion();
  expect("diffusion along the fibres", diffusion[0], along - 1e-14, along + 1e-14);
  expect("diffusion across them", diffusion[1], across - 1e-14, across + 1e-14);

  // a quadratic field has the same load at every horizon: rate 2 at a fixed one
  const scene::Scene quadratic =
      make_scene("x^2 + 3*y^2", text(-(2 * along + 6 * across)), "lattice");
  const double coarse = error(fibres, quadratic, .05, .2),
               fine = error(fibres, quadratic, .0125, .2);
  expect("fibres, rate at a fixed horizon", std::log2(coarse / fine) / 2, 1.8, 2.3);
  expect("fibres, isotropic load",
         error(fibres, make_scene("x^2 + 3*y^2", "-4", "lattice"), .0125, .2), .02,
         1); // the check can fail

  // its local limit: h and the horizon to 0, m to infinity
  const scene::Scene wave = make_scene(
      "sin(3*x)*cos(2*y)", text(9 * along + 4 * across) + "*sin(3*x)*cos(2*y)", "lattice");
  const double far = error(fibres, wave, .05, .2), near = error(fibres, wave, .0125, .1);
  expect("fibres, local limit", near, 0, .01); // a tenth of what the isotropic load errs by
  expect("fibres, local limit approached by a factor", far / near, 3, 10);

  // without fibres it is the library's own
  expect("no fibres: error less the library's",
         error(isotropic, wave, .05, .2) - error(improved, wave, .05, .2), -1e-12, 1e-12);

  // the rule, on a lattice and on the same nodes as a mesh, with the model too
  const scene::Scene plain = make_scene("x^2 + 3*y^2", "-4", "lattice"),
                     mesh = make_scene("x^2 + 3*y^2", "-4", "squares");
  const double of_rule = error(counted, plain, .05, .2);
  expect("SUB over IPA-AC", of_rule / error(improved, plain, .05, .2), .5, 2);
  expect("SUB, lattice less mesh", of_rule - error(counted, mesh, .05, .2), -1e-9, 1e-9);
  expect("SUB with fibres over IPA-AC", error(both, quadratic, .05, .2) / coarse, .5, 2);
  expect("SUB, finer", error(counted, plain, .0125, .2) / of_rule, 0, .3);
  std::cout << (n_failed == 0 ? "all hold\n" : "some fail\n");
  return n_failed == 0 ? 0 : 1;
}
