#include "grade.h"

#include "base/error.h"
#include "base/number_list.h"
#include "base/number_text.h"
#include "io/certified_set.h"
#include "io/certified_values.h"
#include "report/certificate_text.h"

#include <algorithm>
#include <iostream>
#include <numeric>

namespace plumbline::app
{
  using study::Certificate;

  namespace
  {
    /// Mesh sizes of the files; none: not given.
    std::vector<double> sizes_of(const GradeOptions &options)
    {
      if (options.h.empty())
        return {};
      const std::vector<double> h = base::to_numbers(sizes_option, options.h);
      if (h.size() != options.files.size())
        throw InputError(std::string(sizes_option) + " has " + std::to_string(h.size()) +
                         " mesh sizes for " + std::to_string(options.files.size()) +
                         " files; give one for each, in their order");
      for (const double one : h)
        if (!(one > 0) || std::count(h.begin(), h.end(), one) > 1)
          throw InputError(std::string(sizes_option) + ": " + base::to_text(one, 3) +
                           " is not above 0, or there twice; give a mesh size for each file");
      return h;
    }

    /// The problem itself, for another code.
    int show(const Certificate &certificate, const GradeOptions &options)
    {
      if (!options.files.empty() || options.is_points == options.is_scene)
        throw InputError("grade: --points and --scene print the problem and grade nothing; give "
                         "one of them, and no file");
      if (options.is_scene)
        std::cout << certificate.scene_text;
      else
        std::cout << io::points_csv(certificate);
      return 0;
    }
  } // namespace

  int grade(const GradeOptions &options)
  {
    const auto required = study::parse_grade_requirements(options.required);
    const Certificate certificate = io::certificate_of(options.problem, io::prefix_of_command());
    if (options.is_points || options.is_scene)
      return show(certificate, options);
    if (options.files.empty())
      throw InputError("grade: no file of values is given; write plumbline grade FILE --problem " +
                       options.problem + ", or --points for the points at which u is needed");
    std::vector<double> h = sizes_of(options);
    std::vector<std::size_t> order(options.files.size());
    std::iota(order.begin(), order.end(), 0);
    if (!h.empty()) // from coarse to fine
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return h[a] > h[b]; });
    std::sort(h.rbegin(), h.rend());
    std::vector<study::GivenValues> given;
    for (const std::size_t i : order)
      given.push_back(io::read_values(options.files[i], certificate));
    const study::SeriesGrade found = study::grade(certificate, given, h);
    if (!options.quiet)
      std::cout << report::grade_text(certificate, found);
    const std::vector<std::string> missed = study::complaints(required, found);
    for (const std::string &one : missed)
      std::cerr << one << '\n';
    return missed.empty() ? 0 : 1;
  }
} // namespace plumbline::app
