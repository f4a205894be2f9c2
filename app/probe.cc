#include "probe.h"

#include "base/error.h"
#include "base/progress_line.h"
#include "base/text_file.h"
#include "check/probe_words.h"
#include "driver/interrupts.h"

#include <filesystem>
#include <iostream>

namespace plumbline::app
{
  using check::ForceKind;
  using meshfree::ProbeFindings;

  namespace
  {
    template <int dim>
    int probe_in(const ProbeOptions &options, ForceKind kind)
    {
      constexpr double usual_step = 1e-5;
      if (std::filesystem::is_directory(options.output))
        throw InputError("-o " + options.output + " is a folder; give the name of a file");
      const check::ProgramNodes<dim> nodes = check::read_program_nodes<dim>(options.nodes_file);
      const auto plan = meshfree::plan_probe(
          nodes.places, {options.horizon, options.step.value_or(usual_step * options.horizon),
                         options.all ? nodes.id.size() : options.n_nodes});
      const check::ForceProgram<dim> program(options.command, nodes, kind, driver::is_interrupted);
      driver::watch_interrupts("\ninterrupted: stopping the force program\n");
      ProbeFindings found;
      {
        base::ProgressLine progress(!options.quiet && !options.json);
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
      check::refuse_other_forces(found, nodes);
      base::write_file(options.output, check::bonds_csv(found, nodes));
      if (options.json)
        std::cout << check::probe_json(plan, found, nodes, options.output);
      else if (!options.quiet)
        std::cout << check::probe_text(plan, found, nodes, options.nodes_file, options.output);
      return 0;
    }
  } // namespace

  int probe(const ProbeOptions &options)
  {
    const auto kind = base::from_word<ForceKind>(options.forces_are);
    if (!kind)
      throw InputError("--forces-are = '" + options.forces_are +
                       "' is not known; choose one of 'forces', 'densities'");
    driver::end_at_interrupts();
    try
    {
      return check::is_in_space(options.nodes_file) ? probe_in<3>(options, *kind)
                                                    : probe_in<2>(options, *kind);
    }
    catch (const check::Interrupted &)
    {
      std::cerr << "interrupted: nothing is written\n";
      return 130;
    }
  }
} // namespace plumbline::app
