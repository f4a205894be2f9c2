#include "check/moduli.h"
#include "arrays.h"
#include "bindings.h"
#include "io/results_json.h"
#include "meshfree/rules/stiffness.h"
#include "rule.h"

#include <algorithm>
#include <cmath>
#include <numeric>

// Elastic constants of rules on lattices, as `plumbline moduli` computes them, and of weights in
// arrays.
namespace plumbline::python
{
  using namespace py::literals;
  using physics::Kernel;

  namespace
  {
    /// Options of the command are arguments here.
    template <class Action>
    auto in_arguments(const Action &action)
    {
      try
      {
        return action();
      }
      catch (const InputError &error)
      {
        const std::string text = error.what();
        throw InputError(text.compare(0, 2, "--") == 0 ? text.substr(2) : text);
      }
    }

    std::string moduli(const std::string &names, const std::vector<PythonRule> &rules,
                       const std::vector<std::string> &ratios, double E, const std::string &state,
                       const std::string &kernel)
    {
      check::ModuliOptions options;
      options.kernel = kernel;
      options.state = state;
      options.rules = names;
      options.ratios = ratios;
      options.E = E;
      for (const PythonRule &rule : rules)
        options.own_rules.push_back(rule.rule());
      const py::gil_scoped_release others;
      return in_arguments([&] { return io::to_json(check::moduli_of_rules(options)); });
    }

    /// Bonds of nodes in ascending order of the nodes, those of a node as they are given.
    std::vector<std::size_t> by_node(const Integers &i)
    {
      std::vector<std::size_t> order(static_cast<std::size_t>(i.size()));
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [node = i.data()](std::size_t a, std::size_t b)
                       { return node[a] < node[b]; });
      return order;
    }

    struct Constants
    {
      std::vector<std::int64_t> nodes;
      std::vector<double> C1111, C1122, C1212, E, nu, along, across, anisotropy;

      void add(std::int64_t node, const physics::CubicStiffness &stiffness,
               physics::ElasticState state)
      {
        const auto found = physics::engineering_constants(stiffness, state);
        nodes.push_back(node);
        C1111.push_back(stiffness.C1111);
        C1122.push_back(stiffness.C1122);
        C1212.push_back(stiffness.C1212);
        E.push_back(found.E);
        nu.push_back(found.nu);
        along.push_back(found.shear_along);
        across.push_back(found.shear_across);
        anisotropy.push_back(found.anisotropy);
      }
    };

    py::dict moduli_of_weights(const Kernel<2> &kernel, const Doubles &w, const Doubles &xi,
                               const Integers &i, const Doubles &points, const std::string &state)
    {
      const std::vector<Point<2>> bonds = to_points(xi, "xi"), places = to_points(points, "points");
      require_length(w, bonds.size(), "w", "bond");
      require_length(i, bonds.size(), "i", "bond");
      if (places.size() != bonds.size())
        throw InputError("points has " + std::to_string(places.size()) + " rows for " +
                         std::to_string(bonds.size()) +
                         " bonds; give one for each, relative to node i");
      for (std::size_t k = 0; k < bonds.size(); ++k)
        if (!std::isfinite(w.data()[k]) || !(places[k].square() > 0))
          throw InputError("bond " + std::to_string(k) + " has the weight " +
                           std::to_string(w.data()[k]) + " and the kernel point (" +
                           std::to_string(places[k][0]) + ", " + std::to_string(places[k][1]) +
                           "); give finite weights, and points other than 0");
      const auto kind = in_arguments([&] { return check::elastic_state(state); });
      if (kind == physics::ElasticState::solid)
        throw InputError("state = '3D', but bonds are given in the plane; choose 'plane stress' or "
                         "'plane strain'");
      Constants found;
      const std::vector<std::size_t> order = by_node(i);
      std::vector<meshfree::Bond<2>> family;
      for (std::size_t k = 0; k < order.size(); ++k)
      {
        meshfree::Bond<2> bond;
        bond.xi = bonds[order[k]];
        bond.kernel_point = places[order[k]];
        bond.weight = w.data()[order[k]];
        family.push_back(bond);
        const std::int64_t node = i.data()[order[k]];
        if (k + 1 < order.size() && i.data()[order[k + 1]] == node)
          continue;
        found.add(node, meshfree::stiffness(kernel, family), kind);
        family.clear();
      }
      py::dict result("nodes"_a = to_array(std::move(found.nodes)));
      const auto set = [&result](const char *name, std::vector<double> &values)
      { result[name] = to_array(std::move(values)); };
      set("C1111", found.C1111);
      set("C1122", found.C1122);
      set("C1212", found.C1212);
      set("E", found.E);
      set("nu", found.nu);
      set("shear along axes", found.along);
      set("shear across axes", found.across);
      set("anisotropy", found.anisotropy);
      return result;
    }
  } // namespace

  void add_moduli(py::module_ &module)
  {
    module.def("moduli_json", moduli, "names"_a, "rules"_a, "m"_a, "E"_a, "state"_a, "kernel"_a);
    module.def("moduli_arrays", moduli_of_weights, "kernel"_a, "w"_a, "xi"_a, "i"_a, "points"_a,
               "state"_a);
  }
} // namespace plumbline::python
