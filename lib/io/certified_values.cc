#include "io/certified_values.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <sstream>
#include <utility>

namespace plumbline::io
{
  using study::Certificate;

  namespace
  {
    /// The fewest digits that read back to the same double.
    std::string shortest(double value)
    {
      constexpr std::size_t most_characters = 32;
      std::array<char, most_characters> text{};
      return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
    }

    std::vector<std::string> axes_of(const Certificate &certificate)
    {
      std::vector<std::string> axes = {"x", "y", "z"};
      axes.resize(certificate.points.front().x.size());
      return axes;
    }

    /// The columns of u in a file.
    std::vector<std::string> columns_of(const std::string &file, const Certificate &certificate)
    {
      const unsigned int n_components = certificate.n_components;
      if (n_components == 1)
        return {"u"};
      const base::Csv csv(file, axes_of(certificate));
      std::vector<std::string> numbered, lettered = {"u", "v", "w"};
      for (unsigned int c = 1; c <= n_components; ++c)
        numbered.push_back("u" + std::to_string(c));
      lettered.resize(n_components);
      return csv.has("u1") ? numbered : lettered;
    }

    /// @param lines  of the file by points; 0: there is none
    void check_complete(const std::string &file, const std::vector<std::size_t> &lines,
                        const Certificate &certificate)
    {
      const auto first = std::find(lines.begin(), lines.end(), std::size_t(0));
      if (first == lines.end())
        return;
      throw InputError(
          "'" + file + "' lacks " +
          std::to_string(std::count(lines.begin(), lines.end(), std::size_t(0))) + " of the " +
          std::to_string(lines.size()) + " points of the certificate, e.g. " +
          place_text(certificate.points[static_cast<std::size_t>(first - lines.begin())].x) +
          "; give a value at each of them");
    }
  } // namespace

  std::string place_text(const std::vector<double> &x)
  {
    constexpr int n_digits = 12;
    std::string text;
    for (const double one : x)
      text += (text.empty() ? "(" : ", ") + base::to_text(one, n_digits);
    return text + ")";
  }

  std::string points_csv(const Certificate &certificate)
  {
    std::ostringstream text;
    const char *separator = "";
    for (const std::string &axis : axes_of(certificate))
      text << std::exchange(separator, ",") << axis;
    text << '\n';
    for (const study::CertifiedValue &one : certificate.points)
    {
      separator = "";
      for (const double x : one.x)
        text << std::exchange(separator, ",") << shortest(x);
      text << '\n';
    }
    return text.str();
  }

  study::GivenValues read_values(const std::string &file, const Certificate &certificate)
  {
    constexpr int n_digits = 3;
    const unsigned int n = certificate.n_components;
    const std::vector<std::string> axes = axes_of(certificate),
                                   columns = columns_of(file, certificate);
    std::vector<std::string> all = axes;
    all.insert(all.end(), columns.begin(), columns.end());
    base::Csv csv(file, all);
    const study::CertifiedPlaces places(certificate);
    study::GivenValues given{file, std::vector<double>(certificate.points.size() * n)};
    std::vector<std::size_t> lines(certificate.points.size());
    while (csv.next())
    {
      std::vector<double> x;
      for (const std::string &axis : axes)
        x.push_back(csv.number(axis));
      const std::size_t i = places.find(x);
      if (i == certificate.points.size())
        csv.fail(place_text(x) + " is not a point of the certificate, within " +
                 base::to_text(places.tolerance(), n_digits) + "; take it out");
      if (lines[i] > 0)
        csv.fail(place_text(x) + " is in line " + std::to_string(lines[i]) + ", too; take one out");
      lines[i] = csv.line();
      for (unsigned int c = 0; c < n; ++c)
        given.values[i * n + c] = csv.number(columns[c]);
    }
    check_complete(file, lines, certificate);
    return given;
  }
} // namespace plumbline::io
