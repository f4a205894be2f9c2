#include "scene/scene.h"

#include "base/error.h"
#include "base/text_file.h"
#include "scene/checks.h"
#include "scene/material.h"
#include "scene/mesh_files.h"
#include "scene/parameters.h"
#include "scene/scene_file.h"
#include "scene/values.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    std::vector<Series> make_series(Regime regime, const std::vector<double> &h,
                                    const std::vector<double> &m,
                                    const std::vector<double> &horizon)
    {
      std::vector<Series> series;
      switch (regime)
      {
      case Regime::m:
        for (const double delta : horizon)
        {
          series.push_back({"delta = " + short_number(delta), {}});
          for (const double size : h)
            series.back().levels.push_back({size, delta});
        }
        break;
      case Regime::delta:
        for (const double ratio : m)
        {
          series.push_back({"m = " + short_number(ratio), {}});
          for (const double size : h)
            series.back().levels.push_back({size, ratio * size});
        }
        break;
      case Regime::delta_m:
        if (h.size() != m.size())
          throw InputError("Study/m has " + std::to_string(m.size()) + " values and Study/h has " +
                           std::to_string(h.size()) +
                           "; with regime = delta-m give one m for each h");
        series.push_back(
            {"h and m = " + short_number(m.front()) + " to " + short_number(m.back()), {}});
        for (std::size_t i = 0; i < h.size(); ++i)
          series.back().levels.push_back({h[i], m[i] * h[i]});
        break;
      case Regime::horizon:
        for (const double size : h)
        {
          series.push_back({"h = " + short_number(size), {}});
          for (const double delta : horizon)
            series.back().levels.push_back({size, delta});
        }
        break;
      }
      return series;
    }

    std::vector<physics::PowerTerm> make_profile(const physics::KernelType &type,
                                                 const std::vector<double> &coefficients, int a)
    {
      if (!type.profile.empty())
      {
        if (!coefficients.empty())
          throw InputError("Kernel/coefficients is for polynomial kernels, but Kernel/type = '" +
                           type.name + "'; clear it or choose a polynomial type");
        return type.profile;
      }
      if (coefficients.empty())
        throw InputError("Kernel/type = '" + type.name +
                         "' needs its polynomial; give Kernel/coefficients");
      std::vector<physics::PowerTerm> profile;
      for (std::size_t i = 0; i < coefficients.size(); ++i)
        profile.push_back({coefficients[i], static_cast<int>(i) - a});
      return profile;
    }

    /// Solver/iteration and Solver/dilatation fit the rest.
    void check_solver(const Scene &scene)
    {
      const auto needs = [](bool is_good, const std::string &what)
      {
        if (!is_good)
          throw InputError("Solver/" + what);
      };
      const bool is_chosen = scene.solver.iteration != "automatic";
      const bool is_scattered = !scene.domain.mesh.is_lattice() && !scene.domain.is_free_body;
      const std::string iteration = "iteration = " + scene.solver.iteration,
                        kept = "dilatation = kept";
      needs(!is_chosen || scene.solver.linear_solver != "direct",
            iteration + ", but nothing iterates with Solver/linear solver = direct; write "
                        "Solver/iteration = automatic, or another linear solver");
      needs(!is_chosen || scene.solver.iteration == "cg" || is_scattered,
            iteration + " on a " + (scene.domain.is_free_body ? "free body" : "lattice") +
                ": its operator is symmetric positive definite; write automatic or cg");
      if (!scene.solver.is_mixed)
        return;
      needs(scene.has_dilatation(),
            kept + ", but the model has none, being that of state-based solids with lambda != mu; "
                   "write eliminated, or Material/model = LPS");
      needs(is_scattered, kept + " is for scattered nodes, not for lattices and free bodies; write "
                                 "eliminated, or Domain/mesh = squares with a collar");
      needs(scene.solver.linear_solver != "jacobi",
            kept + " makes a system that jacobi does not precondition; write Solver/linear solver "
                   "= automatic, direct or amg");
      needs(scene.solver.iteration != "cg",
            kept + " makes a system that is not symmetric, as cg needs it; write Solver/iteration "
                   "= automatic, gmres or bicgstab");
    }

    Scene build(const std::string &file, dealii::ParameterHandler &parameters)
    {
      const auto value = [&](const std::string &key) { return get(parameters, key); };
      const auto numbers = [&](const std::string &key) { return to_numbers(key, value(key), ','); };
      Scene scene;
      scene.domain.mesh_files = std::make_shared<MeshFiles>();
      scene.name = std::filesystem::path(file).stem().string();
      scene.purpose = value("Purpose");
      std::ostringstream text;
      parameters.print_parameters(text, dealii::ParameterHandler::ShortText);
      scene.text = text.str();

      scene.domain.boxes.include = to_boxes("Domain/boxes", value("Domain/boxes"));
      scene.domain.boxes.exclude = to_boxes("Domain/holes", value("Domain/holes"));
      scene.folder = std::filesystem::path(file).parent_path().string();
      scene.domain.mesh = {value("Domain/mesh"), value("Domain/arguments"), value("Domain/inside"),
                           value("Domain/map")};
      if (value("Domain/collar") != "auto")
        scene.domain.collar = to_number("Domain/collar", value("Domain/collar"));

      scene.domain.is_free_body = value("Domain/boundary") == "free";
      scene.domain.is_floating = value("Domain/fixed") == "none";
      if (!scene.domain.is_floating)
        scene.domain.fixed = to_boxes("Domain/fixed", value("Domain/fixed"));
      scene.domain.cracks = to_polylines("Domain/cracks", value("Domain/cracks"));
      scene.domain.outside = value("Domain/outside");

      const physics::KernelType &type = physics::kernel_type(value("Kernel/type"));
      scene.kernel.type = type.name;
      scene.kernel.structure = type.structure;
      scene.kernel.limit = value("Kernel/limit");
      scene.kernel.bulk_modulus = to_number("Kernel/bulk modulus", value("Kernel/bulk modulus"));
      scene.kernel.constant = to_number("Kernel/constant", value("Kernel/constant"));
      scene.kernel.profile = make_profile(type, numbers("Kernel/coefficients"),
                                          std::stoi(value("Kernel/singularity")));

      scene.kernel.coefficient = value("Kernel/coefficient");
      scene.kernel.materials = to_cases(value("Kernel/materials"));
      scene.kernel.symmetrisation = value("Kernel/symmetrisation") == "harmonic"
                                        ? physics::Mean::harmonic
                                        : physics::Mean::arithmetic;

      scene.material = make_material(value);
      if (value("Solver/model") == "full")
        scene = full_model(std::move(scene));

      scene.problem.solutions = to_cases(value("Problem/solution"));
      if (value("Problem/load") != "manufactured")
        scene.problem.loads = to_cases(value("Problem/load"));
      scene.problem.constraint = value("Problem/constraint");
      scene.problem.local_solution = value("Problem/local solution");
      check_kernel_and_problem(scene);

      scene.methods.names = to_methods(value("Methods/names"));
      if (scene.methods.names.empty())
        throw InputError("Methods/names is empty; name methods ('plumbline list methods'), or all");
      scene.methods.nodes = {value("Methods/nodes"),
                             to_number("Methods/perturbation", value("Methods/perturbation"))};

      scene.methods.loads_are_averages = value("Methods/load") == "cells";

      const std::string regime = value("Study/regime");
      scene.study.regime = regime == "m"         ? Regime::m
                           : regime == "delta"   ? Regime::delta
                           : regime == "horizon" ? Regime::horizon
                                                 : Regime::delta_m;
      const auto h = numbers("Study/h"), m = numbers("Study/m"), horizon = numbers("Study/horizon");
      if (h.empty() || m.empty() || horizon.empty())
        throw InputError("Study/h, Study/m and Study/horizon need at least one value each");
      scene.study.series = make_series(scene.study.regime, h, m, horizon);
      check_levels(scene);

      scene.reference.method = method_name(value("Reference/method"));
      scene.reference.estimate = value("Reference/estimate");
      scene.reference.tolerance = to_number("Reference/tolerance", value("Reference/tolerance"));
      scene.study.norms = to_names(value("Study/norms"));
      scene.study.decisive_error = value("Study/decisive error");
      check_norms(scene);

      scene.quadrature.exact_rectangles = value("Quadrature/rectangles") == "correlation";
      scene.quadrature.tolerance = to_number("Quadrature/tolerance", value("Quadrature/tolerance"));
      scene.quadrature.max_refinements = std::stoi(value("Quadrature/max refinements"));
      scene.geometry.backend =
          value("Geometry/backend") == "cgal" ? geometry::Backend::cgal : geometry::Backend::fast;
      scene.geometry.n_checks = std::stoi(value("Geometry/checks"));
      scene.geometry.seed = std::stoi(value("Geometry/seed"));
      scene.solver.operator_backend = value("Solver/operator");
      check_mesh_and_nodes(scene);
      scene.solver.linear_solver = value("Solver/linear solver");
      scene.solver.iteration = value("Solver/iteration");
      scene.solver.is_mixed = value("Solver/dilatation") == "kept";
      check_solver(scene);
      scene.solver.tolerance = to_number("Solver/tolerance", value("Solver/tolerance"));
      scene.solver.max_iterations = std::stoi(value("Solver/max iterations"));
      scene.output.fields = value("Output/fields") == "true";

      const auto expected = [&](const std::string &key, const std::set<std::string> &words = {})
      { return to_expected(key, value(key), scene.problem.case_names(), words); };
      scene.expected.verdicts =
          expected("Expected/verdicts",
                   {"AC", "not AC", "m-convergent", "not m-convergent", "delta-m-convergent",
                    "not delta-m-convergent", "AC for this field only", "undecided", "failed"});
      scene.expected.errors = expected("Expected/errors");
      scene.expected.rates = expected("Expected/rates");
      scene.expected.bounds = expected("Expected/bounds");
      scene.expected.monotone = expected("Expected/monotone", {"yes", "no"});
      scene.expected.jitter = expected("Expected/jitter");
      scene.expected.stability =
          expected("Expected/stability", {"stable", "conditionally stable", "unstable"});
      scene.expected.error_tolerance =
          to_number("Expected/error tolerance", value("Expected/error tolerance"));
      scene.expected.rate_tolerance =
          to_number("Expected/rate tolerance", value("Expected/rate tolerance"));
      return scene;
    }

    /// @param what  opens messages
    Scene build(const std::string &name, const std::string &what,
                const std::vector<Setting> &settings, const std::vector<Override> &overrides)
    {
      dealii::ParameterHandler parameters;
      declare(parameters);
      const auto change =
          [&](const std::string &key, const std::string &value, const std::string &place)
      {
        try
        {
          set(parameters, key, value);
        }
        catch (const InputError &error)
        {
          throw InputError(what + place + ": " + error.what());
        }
      };
      for (const Setting &setting : settings)
        change(setting.key, setting.value, ", " + setting.place);
      for (const Override &setting : overrides)
        change(setting.key, setting.value, "");
      try
      {
        return build(name, parameters);
      }
      catch (const InputError &error)
      {
        throw InputError(what + ": " + error.what());
      }
    }

    std::string opening(const std::string &file)
    {
      return "scene '" + file + "'";
    }

    /// A scene is a page or two.
    constexpr std::size_t most_bytes = 10'000'000;
  } // namespace

  bool MeshSource::is_file() const
  {
    const std::string ending = std::filesystem::path(kind).extension().string();
    return ending == ".msh" || ending == ".geo";
  }

  std::vector<std::string> ProblemSection::case_names() const
  {
    std::vector<std::string> names;
    for (const Case &one : solutions.empty() ? loads : solutions)
      names.push_back(one.name);
    return names;
  }

  Scene full_model(Scene scene)
  {
    scene.solver.is_full_model = true;
    if (scene.domain.mesh.is_lattice() && !scene.domain.is_free_body)
      scene.domain.mesh.kind = "squares";
    return scene;
  }

  bool Scene::has_dilatation() const
  {
    if (!material.is_state_based())
      return false;
    if (solver.is_full_model || domain.is_damaged() || !material.is_homogeneous)
      return true;
    const physics::Lame lame = material.lame()({});
    return std::abs(lame.lambda - lame.mu) > 1e-14 * lame.mu;
  }

  physics::Kernel<2> make_kernel(const Scene &scene, double horizon)
  {
    const KernelSection &kernel = scene.kernel;
    if (scene.material.is_state_based())
      return physics::deviatoric_kernel(physics::influence_function(kernel.profile, horizon),
                                        scene.material.is_homogeneous && !scene.domain.is_free_body
                                            ? scene.material.lame()({}).mu
                                            : 1);
    if (kernel.limit == "Navier")
      return physics::Kernel<2>::with_bulk_modulus(kernel.profile, horizon, kernel.bulk_modulus);
    if (kernel.limit == "none")
      return physics::Kernel<2>(kernel.structure, kernel.profile, horizon, kernel.constant);
    return physics::Kernel<2>::with_diffusion(kernel.profile, horizon,
                                              kernel.limit == "-Laplace" ? 1 : .5);
  }

  Scene read_scene(const std::string &file, const std::vector<Override> &overrides)
  {
    const std::string what = opening(file);
    const std::string text = base::read_text_file(file, what, most_bytes, "a .prm or .json file");
    const bool is_json = std::filesystem::path(file).extension() == ".json";
    return build(file, what,
                 is_json ? read_json_settings(text, what) : read_settings(file, text, what),
                 overrides);
  }

  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides)
  {
    base::check_text(text, opening(name));
    return build(name, opening(name), read_settings(name, text, opening(name)), overrides);
  }

  std::string scene_template(const std::string &model)
  {
    if (model != "scalar" && model != "tensor" && model != "LPS" && model != "variational")
      throw InputError("template: model '" + model +
                       "' is not known; choose scalar, tensor, LPS or variational");
    dealii::ParameterHandler parameters;
    declare(parameters);
    set(parameters, "Purpose", "Which rules are asymptotically compatible?");
    set(parameters, "Methods/names", "FA, PA-AC, IPA-AC, IPA-AC-R2, Q1, DGQ0");
    if (model == "scalar")
      set(parameters, "Problem/solution", "x^3 + 2*y^2");
    else
    {
      set(parameters, "Kernel/type", model == "tensor" ? "bond-tensor" : "1/r");
      set(parameters, "Kernel/limit", "Navier");
      set(parameters, "Problem/solution", "x*(1-x)/2 + y*(1-y)/2, x*(1-x)/2 + y*(1-y)/2");
    }
    if (model == "LPS")
    {
      set(parameters, "Material/model", model);
      set(parameters, "Material/E", "1");
      set(parameters, "Material/nu", "0.3");
    }
    if (model == "variational")
    {
      set(parameters, "Purpose", "A bar that is held on the left and pulled on the right.");
      set(parameters, "Domain/boxes", "0, 0 : 2, 1");
      set(parameters, "Domain/boundary", "free");
      set(parameters, "Domain/fixed", "0, 0 : 0.1, 1");
      set(parameters, "Material/model", model);
      set(parameters, "Material/k", "100");
      set(parameters, "Material/l", "800");
      set(parameters, "Problem/solution", "");
      set(parameters, "Problem/load", "100*(x > 1.9 - 1e-9), 0");
      set(parameters, "Problem/constraint", "0, 0");
      set(parameters, "Problem/local solution", "none");
      set(parameters, "Methods/names", "FA, PA-AC, IPA-AC");
      set(parameters, "Methods/nodes", "vertices");
      set(parameters, "Study/regime", "m");
      set(parameters, "Study/h", "0.05, 0.025, 0.0125");
      set(parameters, "Study/horizon", "0.05");
      set(parameters, "Study/norms", "averages L2");
      set(parameters, "Study/decisive error", "averages L2 | reference");
      set(parameters, "Reference/method", "DGQ0");
    }
    std::ostringstream text;
    parameters.print_parameters(text, dealii::ParameterHandler::PRM);
    return text.str();
  }
} // namespace plumbline::scene
