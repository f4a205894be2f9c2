#include "check/probe_words.h"

#include "base/error.h"
#include "base/number_text.h"
#include "io/results_json.h"
#include "report/text_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::check
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

    template <int dim>
    std::string bond(const ProbeDefect &defect, const ProgramNodes<dim> &nodes)
    {
      return "nodes " + std::to_string(nodes.id[defect.i]) + " and " +
             std::to_string(nodes.id[defect.j]);
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
  } // namespace

  template <int dim>
  void refuse_other_forces(const ProbeFindings &found, const ProgramNodes<dim> &nodes)
  {
    if (found.noncentral.value > most_noncentral)
      throw InputError(
          "forces are not along the bonds: the block minus k n⊗n (n: direction of the bond) has "
          "the norm " +
          base::to_percent(found.noncentral.value) + " of the largest force constant for " +
          bond(found.noncentral, nodes) +
          ". The program is not bond-based, evaluates kernels at points other than the nodes, or "
          "its bonds are prestressed; probe a bond-based material in the undeformed state, or "
          "export the weights from the program");
    if (found.nonlinearity > most_nonlinear)
      throw InputError(
          "forces are not linear in the displacements: halving the step changes them "
          "by " +
          base::to_percent(found.nonlinearity) +
          " of the largest force constant, so the force constants cannot be determined; give a "
          "smaller --step");
  }

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
  std::string probe_text(const meshfree::ProbePlan<dim> &plan, const ProbeFindings &found,
                         const ProgramNodes<dim> &nodes, const std::string &nodes_file,
                         const std::string &bonds_file)
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
        << "direction  " << number(found.noncentral.value)
        << " is the norm of a block minus k n⊗n, n the direction of the bond\n"
        << "linearity  " << number(found.nonlinearity)
        << " is the change when the step is halved\n";
    constexpr std::size_t n_columns = 120, indent = 2;
    for (const std::string &warning : warnings(found, nodes))
      out << report::wrapped("warning: " + warning, n_columns, indent) << '\n';
    out << "written: " << bonds_file << "\nnext: plumbline check " << nodes_file << ' '
        << bonds_file << " --bonds-are 'force constants' --scene SCENE\n";
    return out.str();
  }

  template <int dim>
  std::string probe_json(const meshfree::ProbePlan<dim> &plan, const ProbeFindings &found,
                         const ProgramNodes<dim> &nodes, const std::string &bonds_file)
  {
    analysis::Record record;
    record.key.analysis = "probe";
    record.key.method = "given forces";
    record.key.horizon = plan.settings.horizon;
    record.set("dimension", dim);
    record.set("nodes", static_cast<double>(nodes.id.size()));
    record.set("displaced nodes", static_cast<double>(plan.displaced.size()));
    record.set("step", plan.settings.step);
    record.set("runs", static_cast<double>(plan.n_runs()));
    record.set("bonds", static_cast<double>(found.bonds.size()));
    record.set("largest force constant", found.largest);
    record.set("pairs with both nodes displaced", static_cast<double>(found.n_two_sided));
    if (found.n_two_sided > 0)
      record.set("asymmetry", found.asymmetry.value);
    record.set("imbalance", found.imbalance);
    record.set("noncentral part", found.noncentral.value);
    record.set("nonlinearity", found.nonlinearity);
    record.set("nodes with forces at rest", static_cast<double>(found.n_loaded));
    record.texts["bonds file"] = bonds_file;
    record.notes = warnings(found, nodes);
    study::StudyResults results;
    results.analysis = "probe";
    results.purpose = "Force constants from the forces of another program";
    results.records = {record};
    return io::to_json(results);
  }

  template void refuse_other_forces(const ProbeFindings &, const ProgramNodes<2> &);
  template void refuse_other_forces(const ProbeFindings &, const ProgramNodes<3> &);
  template std::string bonds_csv(const ProbeFindings &, const ProgramNodes<2> &);
  template std::string bonds_csv(const ProbeFindings &, const ProgramNodes<3> &);
  template std::string probe_text(const meshfree::ProbePlan<2> &, const ProbeFindings &,
                                  const ProgramNodes<2> &, const std::string &,
                                  const std::string &);
  template std::string probe_text(const meshfree::ProbePlan<3> &, const ProbeFindings &,
                                  const ProgramNodes<3> &, const std::string &,
                                  const std::string &);
  template std::string probe_json(const meshfree::ProbePlan<2> &, const ProbeFindings &,
                                  const ProgramNodes<2> &, const std::string &);
  template std::string probe_json(const meshfree::ProbePlan<3> &, const ProbeFindings &,
                                  const ProgramNodes<3> &, const std::string &);
} // namespace plumbline::check
