#include "app/methods.h"
#include "bindings.h"
#include "io/results_json.h"
#include "reading.h"
#include "rule.h"
#include "scene/capabilities.h"
#include "study/dispersion.h"
#include "study/method_names.h"
#include "study/stability.h"
#include "study/statics.h"
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

    /// Ctrl-C ends a study between two solves.
    bool is_interrupted()
    {
      const py::gil_scoped_acquire lock;
      if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
      return false;
    }

    std::string analyse(const study::Analysis &analysis, const scene::Scene &scene,
                        const method::Methods &available, unsigned int n_levels)
    {
      const method::Methods methods = analysis.choose_methods(scene, available, n_levels, 1);
      if (analysis.check)
        analysis.check(scene, methods, n_levels);
      study::RunControl control;
      control.n_levels = n_levels;
      control.should_stop = is_interrupted;
      control.ranks = base::Communicator::all();
      return io::to_json(run_study(analysis, scene, methods, control));
    }

    std::string run(const std::string &text, const py::dict &set,
                    const std::vector<PythonRule> &rules, unsigned int n_levels)
    {
      const std::vector<scene::Override> overrides = to_overrides(set);
      const py::gil_scoped_release others;
      const method::Methods available = available_with(rules);
      const scene::Scene scene = study::with_names_of(scene_of(text, overrides), available);
      if (scene.fracture.is_there())
        throw InputError("scene '" + scene.name +
                         "': Fracture/toughness is for 'plumbline grow', which breaks bonds; clear "
                         "it");
      return analyse(scene.time.is_dynamic() ? study::transient_analysis(available, {})
                                             : study::statics_analysis(available),
                     scene, available, n_levels);
    }

    std::string analyse(const study::Analysis &analysis, const std::string &text,
                        const py::dict &set, const std::vector<PythonRule> &rules,
                        unsigned int n_levels)
    {
      const std::vector<scene::Override> overrides = to_overrides(set);
      const py::gil_scoped_release others;
      const method::Methods available = available_with(rules);
      scene::Scene scene = study::with_names_of(scene_of(text, overrides), available);
      scene.reference.method.reset();
      scene.reference.estimate = scene::Estimate::none;
      return analyse(analysis, scene, available, n_levels);
    }
  } // namespace

  void add_studies(py::module_ &module)
  {
    module.def("run_json", run, "scene"_a, "set"_a, "rules"_a, "levels"_a);
    module.def(
        "stability_json",
        [](const std::string &scene, const py::dict &set, const std::vector<PythonRule> &rules,
           unsigned int levels)
        { return analyse(study::stability_analysis(), scene, set, rules, levels); },
        "scene"_a, "set"_a, "rules"_a, "levels"_a);
    module.def(
        "dispersion_json",
        [](const std::string &scene, const py::dict &set, const std::vector<PythonRule> &rules,
           unsigned int levels, const std::vector<double> &angles,
           const std::vector<std::array<double, 3>> &directions) {
          return analyse(study::dispersion_analysis({angles, directions}), scene, set, rules,
                         levels);
        },
        "scene"_a, "set"_a, "rules"_a, "levels"_a, "angles"_a, "directions"_a);
  }
} // namespace plumbline::python
