#include "bindings.h"
#include "driver/analyse.h"
#include "driver/certify.h"
#include "driver/methods.h"
#include "driver/run.h"
#include "io/certificate_json.h"
#include "io/results_json.h"
#include "reading.h"
#include "rule.h"
#include "scene/required_keys.h"
#include "study/method_names.h"
#include "study/reference_estimate.h"
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
      method::Methods methods = driver::all_methods();
      for (const PythonRule &rule : rules)
        methods.push_back(meshfree::make_method(rule.rule()));
      return methods;
    }

    constexpr auto run_name = "run";

    /// What `plumbline run` does of a scene.
    study::Analysis static_or_in_time(const scene::Scene &scene, const method::Methods &available)
    {
      driver::refuse_growth(scene);
      return scene.time.is_dynamic() ? study::transient_analysis(available, {})
                                     : study::statics_analysis(available);
    }

    /// Ctrl-C ends a study between two solves, and raises KeyboardInterrupt once the study has
    /// written its checkpoint.
    /// @param name    of driver::analyses(), or "run"
    /// @param folder  of the checkpoint of analyses that keep one; exists
    std::string analyse(const std::string &name, const std::string &text, const py::dict &set,
                        const std::vector<PythonRule> &rules, unsigned int n_levels,
                        const std::string &folder, const std::vector<double> &angles,
                        const std::vector<std::array<double, 3>> &directions)
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
        const driver::AnalysisRow *const row = driver::find_analysis(name);
        if (row != nullptr && text.find('\n') == std::string::npos)
          scene::require_keys(name, text, overrides);
        scene::Scene scene = study::with_names_of(scene_of(text, overrides), available);
        if (row == nullptr && name != run_name)
          throw InputError("no analysis is called '" + name + "'");
        if (row != nullptr)
          scene = study::without_reference(scene);
        const study::Analysis analysis =
            row == nullptr ? static_or_in_time(scene, available)
                           : row->make({{folder, should_stop}, {angles, directions}});
        const method::Methods methods = driver::check_methods(analysis, scene, available, n_levels);
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
  } // namespace

  namespace
  {
    /// certificate.json of a scene. Not interrupted until it is done.
    std::string certify(const std::string &text, const py::dict &set, unsigned int reference_level)
    {
      const std::vector<scene::Override> overrides = to_overrides(set);
      const py::gil_scoped_release others;
      const study::Certificate certificate =
          driver::certificate_of(scene_of(text, overrides), reference_level);
      driver::check_certified(certificate, false);
      return io::to_json(certificate);
    }
  } // namespace

  void add_studies(py::module_ &module)
  {
    module.def("certify_json", certify, "scene"_a, "set"_a, "reference_level"_a);
    module.def("study_json", analyse, "analysis"_a, "scene"_a, "set"_a, "rules"_a, "levels"_a,
               "folder"_a = "", "angles"_a = py::tuple(), "directions"_a = py::tuple());
  }
} // namespace plumbline::python
