#include "probe.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/text_file.h"
#include "force_program.h"
#include "meshfree/check/bond_file.h"
#include "meshfree/check/weights_in_space.h"
#include "report/text_table.h"
#include "run_parts.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace plumbline::app
{
  using meshfree::ProbeDefect;
  using meshfree::ProbeFindings;

  namespace
  {
    /// Forces with a larger part across the bonds are not those of bonds.
    constexpr double most_noncentral = 1e-3, most_nonlinear = 1e-3;
    /// Larger defects are worth a warning.
    constexpr double noticeable = 1e-5;

    std::string number(double value)
    {
      constexpr int digits = 3;
      return base::to_text(value, digits);
    }

    bool is_in_space(const std::string &file)
    {
      base::Csv csv(file, {"id", "x", "y", "volume"}, {"id"});
      std::optional<double> first;
      while (csv.has("z") && csv.next())
      {
        const double z = csv.number("z");
        if (z != first.value_or(z))
          return true;
        first = z;
      }
      return false;
    }

    template <int dim>
    ProgramNodes<dim> read_nodes(const std::string &file)
    {
      if constexpr (dim == 2)
      {
        const meshfree::GivenNodes nodes = meshfree::read_given_nodes(file);
        return {nodes.id, nodes.places, nodes.volume};
      }
      else
      {
        const meshfree::WeightsInSpace nodes = meshfree::read_nodes_in_space(file);
        return {nodes.id, nodes.places, nodes.volumes};
      }
    }

    template <int dim>
    std::string bond(const ProbeDefect &defect, const ProgramNodes<dim> &nodes)
    {
      return "nodes " + std::to_string(nodes.id[defect.i]) + " and " +
             std::to_string(nodes.id[defect.j]);
    }

    /// With the digits that are known, by which `check` tells how exact they are.
    template <int dim>
    std::string bonds_csv(const ProbeFindings &found, const ProgramNodes<dim> &nodes)
    {
      constexpr int fewest = 6, most = 15;
      const int known = found.nonlinearity > 0
                            ? 1 + static_cast<int>(std::floor(-std::log10(found.nonlinearity)))
                            : most;
      std::string text = "i,j,weight\n";
      for (const meshfree::ProbedBond &one : found.bonds)
        text += std::to_string(nodes.id[one.i]) + ',' + std::to_string(nodes.id[one.j]) + ',' +
                base::to_text(one.force_constant, std::clamp(known, fewest, most)) + '\n';
      return text;
    }

    template <int dim>
    std::vector<std::string> warnings(const ProbeFindings &found, const ProgramNodes<dim> &nodes)
    {
      std::vector<std::string> result;
      if (found.asymmetry.value > noticeable)
        result.push_back("the force constants k_ij and k_ji of " + bond(found.asymmetry, nodes) +
                         " differ by " + base::to_percent(found.asymmetry.value) +
                         " of the largest force constant: their forces do not balance. For a bond "
                         "with one displaced node, the value found by displacing that node is used "
                         "for both ends; displace all nodes (--all)");
      if (found.imbalance > noticeable)
        result.push_back("the forces due to the displacement of one node sum to " +
                         base::to_percent(found.imbalance) +
                         " of the largest force constant: forces of pairs do not balance, or the "
                         "forces on constrained nodes are set to zero");
      if (found.nonlinearity > noticeable)
        result.push_back("force constants change by " + base::to_percent(found.nonlinearity) +
                         " when the step is halved; give a smaller --step, or a larger one if the "
                         "forces are written with few digits");
      if (found.n_loaded > 0)
        result.push_back(std::to_string(found.n_loaded) +
                         " nodes have forces although no node is displaced, the largest on node " +
                         std::to_string(nodes.id[found.loaded]) +
                         "; give the undeformed state without loads");
      return result;
    }

    template <int dim>
    std::string text(const ProbeOptions &options, const meshfree::ProbePlan<dim> &plan,
                     const ProbeFindings &found, const ProgramNodes<dim> &nodes)
    {
      std::ostringstream out;
      out << "nodes      " << nodes.id.size() << " in " << dim << "D, " << plan.displaced.size()
          << " displaced by " << number(plan.settings.step) << " along each axis\n"
          << "runs       " << plan.n_runs() << " of the command, for " << plan.groups.size()
          << " groups of nodes\n"
          << "bonds      " << found.bonds.size() << ", force constants up to "
          << number(found.largest) << "\ndefects    relative to the largest force constant\n"
          << "symmetry   ";
      if (found.n_two_sided == 0)
        out << "not known: no two neighbours were displaced\n";
      else
        out << number(found.asymmetry.value) << " between the two ends, of " << found.n_two_sided
            << " pairs\n";
      out << "balance    " << number(found.imbalance)
          << " is the norm of the sum of all forces due to one displacement\n"
          << "direction  " << number(found.noncentral.value) << " is not along the bond\n"
          << "linearity  " << number(found.nonlinearity)
          << " is the change when the step is halved\n";
      constexpr std::size_t n_columns = 120, indent = 2;
      for (const std::string &warning : warnings(found, nodes))
        out << report::wrapped("warning: " + warning, n_columns, indent) << '\n';
      out << "written: " << options.output << "\nnext: plumbline check " << options.nodes_file
          << ' ' << options.output << " --bonds-are 'force constants' --scene SCENE\n";
      return out.str();
    }

    template <int dim>
    int probe_in(const ProbeOptions &options, ForceKind kind)
    {
      constexpr double usual_step = 1e-5;
      if (std::filesystem::is_directory(options.output))
        throw InputError("-o " + options.output + " is a folder; give the name of a file");
      const ProgramNodes<dim> nodes = read_nodes<dim>(options.nodes_file);
      const auto plan = meshfree::plan_probe(
          nodes.places, {options.horizon, options.step.value_or(usual_step * options.horizon),
                         options.all ? nodes.id.size() : options.n_nodes});
      const ForceProgram<dim> program(options.command, nodes, kind);
      watch_interrupts("\ninterrupted: stopping the force program\n");
      ProbeFindings found;
      {
        ProgressLine progress(!options.quiet);
        std::size_t n_done = 0;
        found = meshfree::probe<dim>(
            plan,
            [&](const meshfree::NodeVectors<dim> &displacements)
            {
              const std::string what =
                  "run " + std::to_string(n_done + 1) + " of " + std::to_string(plan.n_runs());
              progress.show(what, static_cast<double>(n_done) / static_cast<double>(plan.n_runs()));
              ++n_done;
              return program.run(displacements);
            });
      }
      if (found.noncentral.value > most_noncentral)
        throw InputError(
            "forces are not along the bonds: " + base::to_percent(found.noncentral.value) +
            " of the largest force constant are not, of " + bond(found.noncentral, nodes) +
            ". The program is not bond-based, evaluates kernels at points other than the nodes, or "
            "its bonds are under load; probe a bond-based material in the undeformed state, or "
            "export the weights from the program");
      if (found.nonlinearity > most_nonlinear)
        throw InputError(
            "forces are not linear in the displacements: halving the step changes them "
            "by " +
            base::to_percent(found.nonlinearity) +
            " of the largest force constant, so the force constants cannot be determined; give a "
            "smaller --step");
      base::write_file(options.output, bonds_csv(found, nodes));
      if (!options.quiet)
        std::cout << text(options, plan, found, nodes);
      return 0;
    }
  } // namespace

  int probe(const ProbeOptions &options)
  {
    const auto kind = base::from_word<ForceKind>(options.forces_are);
    if (!kind)
      throw InputError("--forces-are = '" + options.forces_are +
                       "' is not known; choose of 'forces', 'densities'");
    end_at_interrupts();
    try
    {
      return is_in_space(options.nodes_file) ? probe_in<3>(options, *kind)
                                             : probe_in<2>(options, *kind);
    }
    catch (const Interrupted &)
    {
      std::cerr << "interrupted: nothing is written\n";
      return 130;
    }
  }
} // namespace plumbline::app
