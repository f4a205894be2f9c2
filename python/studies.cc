#include "app/methods.h"
#include "bindings.h"
#include "io/results_json.h"
#include "reading.h"
#include "rule.h"
#include "scene/capabilities.h"
#include "study/crack_analysis.h"
#include "study/dispersion.h"
#include "study/growth_analysis.h"
#include "study/method_names.h"
#include "study/stability.h"
#include "study/statics.h"
#include "study/stationary_crack.h"
#include "study/transient.h"

#include <pybind11/stl.h>

// Studies of scenes, as the command makes them: results leave as the JSON that it writes, whose
// numbers read back to the same bits.
namespace plumbline::python
{
  using namespace py::literals;

  scene::Scene scene_of(const std::string &text, const std::vector<scene::Override> &overrides)
  {
    return text.find('\n') == std::string::npos ? scene::read_scene(text, overrides)
                                                : scene::parse_scene("text", text, overrides);
  }

  std::vector<scene::Override> to_overrides(const py::dict &set)
  {
    std::vector<scene::Override> overrides;
    for (const auto &[key, value] : set)
    {
      const bool is_truth = py::isinstance<py::bool_>(value);
      overrides.push_back({py::str(key), is_truth ? (value.cast<bool>() ? "true" : "false")
                                                  : py::str(value).cast<std::string>()});
    }
    return overrides;
  }

  namespace
  {
    method::Methods available_with(const std::vector<PythonRule> &rules)
    {
      method::Methods methods = app::all_methods();
      for (const PythonRule &rule : rules)
        methods.push_back(meshfree::make_method(rule.rule()));
      return methods;
    }

    /// What is analysed of a scene, which it may change.
    using MakeAnalysis =
        std::function<study::Analysis(scene::Scene &, const method::Methods &available,
                                      const std::function<bool()> &should_stop)>;

    /// Ctrl-C ends a study between two solves, and raises KeyboardInterrupt once the study has
    /// written its checkpoint.
    std::string analyse(const MakeAnalysis &make, const std::string &text, const py::dict &set,
                        const std::vector<PythonRule> &rules, unsigned int n_levels)
    {
      const std::vector<scene::Override> overrides = to_overrides(set);
      bool is_interrupted = false;
      const auto should_stop = [&is_interrupted]
      {
        const py::gil_scoped_acquire lock;
        is_interrupted = is_interrupted || PyErr_CheckSignals() != 0;
        return is_interrupted;
      };
      std::string results;
      {
        const py::gil_scoped_release others;
        const method::Methods available = available_with(rules);
        scene::Scene scene = study::with_names_of(scene_of(text, overrides), available);
        const study::Analysis analysis = make(scene, available, should_stop);
        const method::Methods methods = analysis.choose_methods(scene, available, n_levels, 1);
        if (analysis.check)
          analysis.check(scene, methods, n_levels);
        study::RunControl control;
        control.n_levels = n_levels;
        control.should_stop = should_stop;
        control.ranks = base::Communicator::all();
        results = io::to_json(run_study(analysis, scene, methods, control));
      }
      if (is_interrupted)
        throw py::error_already_set();
      return results;
    }

    study::Analysis static_or_in_time(scene::Scene &scene, const method::Methods &available,
                                      const std::function<bool()> & /*should_stop*/)
    {
      if (scene.fracture.is_there())
        throw InputError("scene '" + scene.name +
                         "': Fracture/toughness is for plumbline.grow, which breaks bonds; clear "
                         "it");
      return scene.time.is_dynamic() ? study::transient_analysis(available, {})
                                     : study::statics_analysis(available);
    }

    /// Without the scene's reference.
    MakeAnalysis alone(const study::Analysis &analysis)
    {
      return [analysis](scene::Scene &scene, const method::Methods &, const std::function<bool()> &)
      {
        scene.reference.method.reset();
        scene.reference.estimate = scene::Estimate::none;
        return analysis;
      };
    }

    /// Of an analysis that keeps a checkpoint.
    /// @param folder  of the checkpoint, which exists
    MakeAnalysis resumable(study::Analysis (*analysis)(const study::Checkpoints &),
                           const std::string &folder)
    {
      return [=](scene::Scene &scene, const method::Methods &available,
                 const std::function<bool()> &should_stop) {
        return alone(analysis({folder, should_stop}))(scene, available, should_stop);
      };
    }
  } // namespace

  void add_studies(py::module_ &module)
  {
    using Rules = std::vector<PythonRule>;
    module.def(
        "run_json",
        [](const std::string &scene, const py::dict &set, const Rules &rules, unsigned int levels)
        { return analyse(static_or_in_time, scene, set, rules, levels); },
        "scene"_a, "set"_a, "rules"_a, "levels"_a);
    module.def(
        "stability_json",
        [](const std::string &scene, const py::dict &set, const Rules &rules, unsigned int levels)
        { return analyse(alone(study::stability_analysis()), scene, set, rules, levels); },
        "scene"_a, "set"_a, "rules"_a, "levels"_a);
    module.def(
        "dispersion_json",
        [](const std::string &scene, const py::dict &set, const Rules &rules, unsigned int levels,
           const std::vector<double> &angles, const std::vector<std::array<double, 3>> &directions)
        {
          return analyse(alone(study::dispersion_analysis({angles, directions})), scene, set, rules,
                         levels);
        },
        "scene"_a, "set"_a, "rules"_a, "levels"_a, "angles"_a, "directions"_a);
    module.def(
        "strip_json",
        [](const std::string &scene, const py::dict &set, unsigned int levels)
        { return analyse(alone(study::strip_analysis()), scene, set, {}, levels); },
        "scene"_a, "set"_a, "levels"_a);
    module.def(
        "grow_json",
        [](const std::string &scene, const py::dict &set, const std::string &folder)
        {
          const auto grow = [](const study::Checkpoints &kept)
          { return study::growth_analysis(kept, {}); };
          return analyse(resumable(grow, folder), scene, set, {}, 0);
        },
        "scene"_a, "set"_a, "folder"_a);
    module.def(
        "crack_json",
        [](const std::string &scene, const py::dict &set, unsigned int levels,
           const std::string &folder)
        {
          const auto crack = [](const study::Checkpoints &kept)
          { return study::crack_analysis(kept); };
          return analyse(resumable(crack, folder), scene, set, {}, levels);
        },
        "scene"_a, "set"_a, "levels"_a, "folder"_a);
  }
} // namespace plumbline::python
