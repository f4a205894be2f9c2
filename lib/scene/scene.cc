#include "scene/scene.h"

#include "base/error.h"
#include "physics/expression.h"
#include "scene/parameters.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    using physics::split_outside_brackets;

    std::string trim(const std::string &text) { return split_outside_brackets(text, '\0')[0]; }

    double to_number(const std::string &key, const std::string &text)
    {
      std::size_t used = 0;
      double value = 0;
      try
      {
        value = std::stod(text, &used);
      }
      catch (const std::exception &)
      {
      }
      if (used == 0 || used != text.size() || !std::isfinite(value))
        throw InputError(key + ": '" + text + "' is not a number");
      return value;
    }

    std::vector<double> to_numbers(const std::string &key, const std::string &text, char separator)
    {
      std::vector<double> values;
      for (const std::string &part : split_outside_brackets(text, separator))
        if (!part.empty())
          values.push_back(to_number(key, part));
      return values;
    }

    std::vector<std::string> to_names(const std::string &text)
    {
      std::vector<std::string> names;
      for (const std::string &part : split_outside_brackets(text, ','))
        if (!part.empty())
          names.push_back(part);
      return names;
    }

    std::vector<geometry::Box> to_boxes(const std::string &key, const std::string &text)
    {
      std::vector<geometry::Box> boxes;
      for (const std::string &part : split_outside_brackets(text, ';'))
      {
        if (part.empty())
          continue;
        const auto corners = split_outside_brackets(part, ':');
        std::vector<double> numbers;
        for (const std::string &corner : corners)
          for (const double x : to_numbers(key, corner, ','))
            numbers.push_back(x);
        if (corners.size() != 2 || numbers.size() != 4)
          throw InputError(key + ": '" + part + "' is not a box; write 'x0, y0 : x1, y1'");
        if (!(numbers[0] < numbers[2]) || !(numbers[1] < numbers[3]))
          throw InputError(key + ": the box '" + part +
                           "' is empty; its second corner must be above and right of its first");
        boxes.push_back({{numbers[0], numbers[1]}, {numbers[2], numbers[3]}});
      }
      return boxes;
    }

    /// "name: expression; ..." or a single expression, whose case is called "u".
    std::vector<Case> to_cases(const std::string &text)
    {
      std::vector<Case> cases;
      for (const std::string &part : split_outside_brackets(text, ';'))
      {
        if (part.empty())
          continue;
        const auto colon = part.find(':');
        const std::string name = trim(part.substr(0, colon));
        const bool is_named =
            colon != std::string::npos && part.find('?') > colon && !name.empty() &&
            std::all_of(name.begin(), name.end(), [](unsigned char c) {
              return std::isalnum(c) != 0 || c == '_' || c == '-' || c == ' ';
            });
        if (is_named)
          cases.push_back({name, trim(part.substr(colon + 1))});
        else
          cases.push_back({"u", part});
      }
      return cases;
    }

    /// A short decimal text, as in series names: 3, 0.4, 2.5.
    std::string short_number(double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    /// "method[, case][, series]: value"; the series is the part with '='.
    std::vector<Expected> to_expected(const std::string &key, const std::string &text,
                                      const std::vector<std::string> &cases, bool is_verdict)
    {
      std::vector<Expected> list;
      for (const std::string &part : split_outside_brackets(text, ';'))
      {
        if (part.empty())
          continue;
        const auto colon = part.rfind(':');
        if (colon == std::string::npos)
          throw InputError(key + ": '" + part + "' has no ':'; write 'method[, case][, series]: " +
                           (is_verdict ? "verdict'" : "numbers'"));
        Expected expected;
        expected.text = part;
        const auto subject = to_names(part.substr(0, colon));
        for (std::size_t i = 0; i < subject.size(); ++i)
          if (i == 0)
            expected.method = subject[i];
          else if (subject[i].find('=') != std::string::npos)
            expected.series = subject[i];
          else if (std::find(cases.begin(), cases.end(), subject[i]) != cases.end())
            expected.problem = subject[i];
          else
            throw InputError(key + ": '" + subject[i] + "' in '" + part +
                             "' is neither a case of Problem nor a series like 'm = 3'");
        if (is_verdict)
          expected.verdict = trim(part.substr(colon + 1));
        else
          expected.values = to_numbers(key, part.substr(colon + 1), ' ');
        list.push_back(expected);
      }
      return list;
    }

    std::vector<Series> make_series(Regime regime, const std::vector<double> &h,
                                    const std::vector<double> &m, const std::vector<double> &horizon)
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
        series.push_back({"h and m = " + short_number(m.front()) + " to " + short_number(m.back()),
                          {}});
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

    void check_levels(const Scene &scene)
    {
      for (const Series &series : scene.series)
        for (const Level &level : series.levels)
        {
          std::ostringstream message;
          if (!(level.h > 0))
            message << "Study/h = " << level.h << " must be a positive length";
          else if (level.horizon < level.h * (1 - 1e-12))
            message << "the horizon " << level.horizon << " is smaller than the mesh size "
                    << level.h << " (m = " << level.horizon / level.h
                    << "), so a node has no neighbours; use m = horizon / h >= 1 "
                       "(Study/m, Study/horizon, Study/h)";
          else if (scene.collar && *scene.collar < level.horizon * (1 - 1e-12))
            message << "Domain/collar = " << *scene.collar << " is thinner than the horizon "
                    << level.horizon
                    << ", so balls would reach points without data; widen it or write auto";
          else
          {
            (void)geometry::Lattice(scene.domain, level.h);
            continue;
          }
          throw InputError(message.str());
        }
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

    void check_kernel_and_problem(const Scene &scene)
    {
      const bool is_tensor = scene.structure == physics::Structure::tensor;
      if (scene.limit == "Navier" && !is_tensor)
        throw InputError("Kernel/limit = Navier does not fit the scalar kernel '" +
                         scene.kernel_type +
                         "'; choose a bond tensor (Kernel/type) or a Laplace limit");
      if (is_tensor && scene.limit.find("Laplace") != std::string::npos)
        throw InputError("Kernel/limit = '" + scene.limit + "' does not fit the bond tensor '" +
                         scene.kernel_type + "'; write Kernel/limit = Navier, or none");
      const unsigned int n_components = is_tensor ? 2 : 1;
      const auto check = [&](const std::string &key, const std::string &expression) {
        const physics::Expression parsed(key, expression, {{"delta", 1.}});
        if (parsed.n_components() != n_components)
          throw InputError(key + " = '" + expression + "' has " +
                           std::to_string(parsed.n_components()) + " component(s), but the " +
                           (is_tensor ? "bond tensor" : "scalar kernel") + " needs " +
                           std::to_string(n_components) +
                           "; give one expression a component, separated by ','");
      };
      for (const Case &solution : scene.solutions)
        check("Problem/solution", solution.expression);
      for (const Case &load : scene.loads)
        check("Problem/load", load.expression);
      if (scene.constraint != "solution")
        check("Problem/constraint", scene.constraint);
      if (scene.local_solution != "solution" && scene.local_solution != "none")
        check("Problem/local solution", scene.local_solution);

      if (scene.solutions.empty() && scene.loads.empty())
        throw InputError("Problem/load = manufactured needs Problem/solution; give the solution, or "
                         "the load itself");
      if (scene.solutions.empty() && scene.constraint == "solution")
        throw InputError("Problem/constraint = solution, but Problem/solution is empty; give the "
                         "constraint as an expression");
      if (!scene.loads.empty() && !scene.solutions.empty() &&
          scene.loads.size() != scene.solutions.size())
        throw InputError("Problem/load has " + std::to_string(scene.loads.size()) +
                         " cases and Problem/solution has " +
                         std::to_string(scene.solutions.size()) + "; give one load a solution");
    }

    void check_norms(const Scene &scene)
    {
      static const std::vector<std::string> known = {"nodal Linf", "nodal L2", "averages Linf",
                                                     "averages L2", "field Linf", "field L2"};
      for (const std::string &norm : scene.norms)
        if (std::find(known.begin(), known.end(), norm) == known.end())
          throw InputError("Study/norms: '" + norm +
                           "' is not a norm; choose of nodal Linf, nodal L2, averages Linf, "
                           "averages L2, field Linf, field L2");
      const auto parts = split_outside_brackets(scene.decisive_error, '|');
      const bool is_known_target = parts.size() == 2 && (parts[1] == "exact" || parts[1] == "local" ||
                                                         parts[1] == "reference");
      if (!is_known_target ||
          std::find(scene.norms.begin(), scene.norms.end(), parts[0]) == scene.norms.end())
        throw InputError("Study/decisive error = '" + scene.decisive_error +
                         "' must be 'norm | target' with a norm of Study/norms and a target of "
                         "exact, local, reference");
      if (parts[1] == "exact" && scene.solutions.empty())
        throw InputError("Study/decisive error = '" + scene.decisive_error +
                         "' needs Problem/solution, which is empty; use the target reference");
      if (parts[1] == "reference" && scene.reference == "none")
        throw InputError("Study/decisive error = '" + scene.decisive_error +
                         "' needs Reference/method, which is none");
      if (parts[1] == "reference" && parts[0].compare(0, 8, "averages") != 0)
        throw InputError("Study/decisive error = '" + scene.decisive_error +
                         "': solutions are held against a reference by cell averages; use averages "
                         "L2 or averages Linf");
    }

    Scene build(const std::string &name, dealii::ParameterHandler &parameters)
    {
      const auto value = [&](const std::string &key) { return get(parameters, key); };
      const auto numbers = [&](const std::string &key) { return to_numbers(key, value(key), ','); };
      Scene scene;
      scene.name = name;
      scene.purpose = value("Purpose");
      std::ostringstream text;
      parameters.print_parameters(text, dealii::ParameterHandler::ShortText);
      scene.text = text.str();

      scene.domain.include = to_boxes("Domain/boxes", value("Domain/boxes"));
      scene.domain.exclude = to_boxes("Domain/holes", value("Domain/holes"));
      if (value("Domain/collar") != "auto")
        scene.collar = to_number("Domain/collar", value("Domain/collar"));

      const physics::KernelType &type = physics::kernel_type(value("Kernel/type"));
      scene.kernel_type = type.name;
      scene.structure = type.structure;
      scene.limit = value("Kernel/limit");
      scene.bulk_modulus = to_number("Kernel/bulk modulus", value("Kernel/bulk modulus"));
      scene.kernel_constant = to_number("Kernel/constant", value("Kernel/constant"));
      scene.profile = make_profile(type, numbers("Kernel/coefficients"),
                                   std::stoi(value("Kernel/singularity")));

      scene.solutions = to_cases(value("Problem/solution"));
      if (value("Problem/load") != "manufactured")
        scene.loads = to_cases(value("Problem/load"));
      scene.constraint = value("Problem/constraint");
      scene.local_solution = value("Problem/local solution");
      check_kernel_and_problem(scene);

      scene.methods = to_names(value("Methods/names"));
      if (scene.methods.empty())
        throw InputError("Methods/names is empty; name methods ('plumbline list methods'), or all");
      scene.nodes_at_vertices = value("Methods/nodes") == "vertices";

      const std::string regime = value("Study/regime");
      scene.regime = regime == "m"       ? Regime::m
                     : regime == "delta" ? Regime::delta
                     : regime == "horizon" ? Regime::horizon
                                           : Regime::delta_m;
      const auto h = numbers("Study/h"), m = numbers("Study/m"), horizon = numbers("Study/horizon");
      if (h.empty() || m.empty() || horizon.empty())
        throw InputError("Study/h, Study/m and Study/horizon need at least one value each");
      scene.series = make_series(scene.regime, h, m, horizon);
      check_levels(scene);

      scene.reference = value("Reference/method");
      scene.estimate_reference = value("Reference/estimate") == "true";
      scene.norms = to_names(value("Study/norms"));
      scene.decisive_error = value("Study/decisive error");
      check_norms(scene);

      scene.backend = value("Geometry/backend") == "cgal" ? geometry::Backend::cgal
                                                          : geometry::Backend::fast;
      scene.n_geometry_checks = std::stoi(value("Geometry/checks"));
      scene.seed = std::stoi(value("Geometry/seed"));
      scene.operator_road = value("Solver/operator");
      scene.tolerance = to_number("Solver/tolerance", value("Solver/tolerance"));
      scene.max_iterations = std::stoi(value("Solver/max iterations"));
      scene.write_fields = value("Output/fields") == "true";

      const auto expected = [&](const std::string &key, bool is_verdict = false) {
        return to_expected(key, value(key), scene.case_names(), is_verdict);
      };
      scene.expected_verdicts = expected("Expected/verdicts", true);
      scene.expected_errors = expected("Expected/errors");
      scene.expected_rates = expected("Expected/rates");
      scene.expected_bounds = expected("Expected/bounds");
      scene.error_tolerance = to_number("Expected/error tolerance", value("Expected/error tolerance"));
      scene.rate_tolerance = to_number("Expected/rate tolerance", value("Expected/rate tolerance"));
      return scene;
    }

    /// deal.II's own words about a bad file, without its frame.
    std::string reason(const dealii::ExceptionBase &error)
    {
      std::ostringstream text;
      error.print_info(text);
      std::string line = text.str();
      std::replace(line.begin(), line.end(), '\n', ' ');
      return trim(line);
    }

    Scene parse(const std::string &name, std::istream &input, bool is_json,
                const std::vector<Override> &overrides)
    try
    {
      dealii::ParameterHandler parameters;
      declare(parameters);
      try
      {
        if (is_json)
          parameters.parse_input_from_json(input);
        else
          parameters.parse_input(input, name, "", false);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(reason(error) +
                         " ('plumbline describe Section' lists the keys of a section)");
      }
      for (const Override &change : overrides)
        set(parameters, change.key, change.value);
      return build(std::filesystem::path(name).stem().string(), parameters);
    }
    catch (const InputError &error)
    {
      throw InputError("scene '" + name + "': " + error.what());
    }
  } // namespace

  std::vector<std::string> Scene::case_names() const
  {
    std::vector<std::string> names;
    for (const Case &one : solutions.empty() ? loads : solutions)
      names.push_back(one.name);
    return names;
  }

  physics::Kernel<2> Scene::kernel(double horizon) const
  {
    if (limit == "Navier")
      return physics::Kernel<2>::with_bulk_modulus(profile, horizon, bulk_modulus);
    if (limit == "none")
      return physics::Kernel<2>(structure, profile, horizon, kernel_constant);
    return physics::Kernel<2>::with_diffusion(profile, horizon, limit == "-Laplace" ? 1 : .5);
  }

  Scene read_scene(const std::string &file, const std::vector<Override> &overrides)
  {
    std::ifstream input(file);
    if (!input || std::filesystem::is_directory(file))
      throw InputError("scene '" + file + "' cannot be read; give a .prm or .json file");
    const std::string ending = std::filesystem::path(file).extension().string();
    return parse(file, input, ending == ".json", overrides);
  }

  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides)
  {
    std::istringstream input(text);
    return parse(name, input, false, overrides);
  }

  std::string scene_template(const std::string &model)
  {
    if (model != "scalar" && model != "tensor")
      throw InputError("template: model '" + model + "' is not known; choose scalar or tensor");
    dealii::ParameterHandler parameters;
    declare(parameters);
    set(parameters, "Purpose", "Which rules are asymptotically compatible?");
    set(parameters, "Methods/names", "FA, PA-AC, IPA-AC, IPA-AC-R2, Q1, DGQ0");
    if (model == "scalar")
      set(parameters, "Problem/solution", "x^3 + 2*y^2");
    else
    {
      set(parameters, "Kernel/type", "bond-tensor");
      set(parameters, "Kernel/limit", "Navier");
      set(parameters, "Problem/solution", "x*(1-x)/2 + y*(1-y)/2, x*(1-x)/2 + y*(1-y)/2");
    }
    std::ostringstream text;
    parameters.print_parameters(text, dealii::ParameterHandler::PRM);
    return text.str();
  }
} // namespace plumbline::scene
