#include "driver/analyses.h"

#include "report/frames.h"
#include "study/crack_analysis.h"
#include "study/growth_analysis.h"
#include "study/stability.h"
#include "study/stationary_crack.h"

namespace plumbline::driver
{
  namespace
  {
    /// States of a strip for ParaView.
    study::WriteStrip strip_frames(const std::filesystem::path &folder)
    {
      return [folder](const std::vector<double> &times, const std::vector<dealii::Point<2>> &nodes,
                      const study::Vector &u_of_nodes, const study::Vector &damage_of_nodes)
      {
        const auto u = [&](std::size_t node, unsigned int component)
        { return u_of_nodes[component * nodes.size() + node]; };
        const auto damage = [&](std::size_t node, unsigned int) { return damage_of_nodes[node]; };
        report::write_frame(folder, "frame", times, nodes,
                            {{"u", true, u}, {"damage", false, damage}});
      };
    }

    study::WriteDamage damage_frames(const std::filesystem::path &folder)
    {
      return [folder](const std::vector<double> &loads, const std::vector<dealii::Point<3>> &nodes,
                      const std::vector<double> &damage)
      {
        report::write_frame(
            folder, "damage", loads, nodes,
            {{"damage", false, [&](std::size_t node, unsigned int) { return damage[node]; }}});
      };
    }

    study::Analysis crack(const Asked &asked)
    {
      const auto &kept = asked.checkpoints;
      return study::crack_analysis(kept, asked.has_frames ? strip_frames(kept.folder / "frames")
                                                          : study::WriteStrip());
    }

    study::Analysis growth(const Asked &asked)
    {
      const auto &kept = asked.checkpoints;
      if (!asked.has_frames)
        return study::growth_analysis(kept, {});
      return study::growth_analysis(kept, damage_frames(kept.folder / "frames"),
                                    strip_frames(kept.folder / "frames"));
    }
  } // namespace

  const std::vector<AnalysisRow> &analyses()
  {
    static const std::vector<AnalysisRow> rows = {
        {"stability", "Stability analysis: eigenvalues, signs, modes, weights, time steps",
         "Expected/stability fails", [](const Asked &) { return study::stability_analysis(); },
         report::stability_view},
        {"dispersion", "Dispersion analysis: wave speeds and critical time steps of each method",
         "Expected/values fails",
         [](const Asked &asked) { return study::dispersion_analysis(asked.directions); },
         report::dispersion_view, false, true},
        {"crack", "Dynamic fracture of a notched strip: tip, energies, contour plots",
         "Expected/crack fails", crack, report::crack_view, true},
        {"grow", "Fracture bond by bond, quasi-static or dynamic: load, energies, contour plots",
         "Expected/growth, Expected/growth ends or the energy balance fails", growth,
         report::growth_view, true},
        {"strip", "Stationary crack: tip energy by meshfree and Galerkin methods",
         "Expected/strip fails, or a strip is too short",
         [](const Asked &) { return study::strip_analysis(); }, report::strip_view}};
    return rows;
  }

  const AnalysisRow *find_analysis(const std::string &name)
  {
    for (const AnalysisRow &row : analyses())
      if (row.name == name)
        return &row;
    return nullptr;
  }
} // namespace plumbline::driver
