#pragma once

#include "study/certificate.h"
#include "study/trend.h"

#include <limits>
#include <string>
#include <vector>

// Another code's values at the points of a certificate: how many of their digits are right, at
// which order they converge, and to what.
namespace plumbline::study
{
  /// Finds points of a certificate.
  class CertifiedPlaces
  {
  public:
    /// @param certificate  outlives it
    explicit CertifiedPlaces(const Certificate &certificate);

    /// Points are the same within this: 1e-9 of their extent, for rounding of files [length].
    double tolerance() const;

    /// The number of the point there; as many as there are points: none.
    std::size_t find(const std::vector<double> &x) const;

  private:
    const std::vector<CertifiedValue> &points_;
    double extent_ = 0;
  };

  /// Values of one grid.
  struct GivenValues
  {
    std::string name;           ///< e.g. of their file
    std::vector<double> values; ///< shape (n_points, n_components), in the certificate's order
  };

  /// Errors are differences from the certified values, relative to Certificate::size.
  struct Grade
  {
    std::string name;
    double h = 0; ///< [length]; 0: not given
    double largest = 0, root_mean_square = 0;
    /// floor(-log10) of the largest difference and bound together; `is_at_least`: no difference is
    /// above its bound, so that the certificate cannot tell more.
    unsigned int digits = 0;
    bool is_at_least = false;
    /// Of the root mean squares, from the grid before; NaN: there is none, or one of the two is no
    /// larger than the bounds.
    double order = std::numeric_limits<double>::quiet_NaN();
  };

  /// Where the values tend to.
  enum class GradedLimit
  {
    certified,  ///< to the certified solution
    another,    ///< to another one
    not_decided ///< the reason says what would help
  };

  struct SeriesGrade
  {
    std::vector<Grade> grades; ///< of the grids, from coarse to fine where sizes are given
    Slope order; ///< of the root mean squares above the bounds, least squares; NaN: fewer than two
    /// By the three finest grids: order of the values' own changes; the grid convergence index of
    /// the finest one (Roache 1994, doi 10.1115/1.2910291: 1.25 times the extrapolated error);
    /// distance of the extrapolated limit from the certified values, and their bound. Root mean
    /// squares over the points, relative to Certificate::size; NaN: not known.
    double own_order = std::numeric_limits<double>::quiet_NaN();
    double index = std::numeric_limits<double>::quiet_NaN();
    double limit_distance = std::numeric_limits<double>::quiet_NaN();
    double bound = 0;
    GradedLimit limit = GradedLimit::not_decided;
    std::string reason; ///< one sentence with the numbers

    const Grade &finest() const { return grades.back(); }
  };

  /// @param h  of the grids, decreasing, as many as these; or empty: each is graded alone
  /// @throws InputError  another number of values than the certificate has
  SeriesGrade grade(const Certificate &certificate, const std::vector<GivenValues> &given,
                    const std::vector<double> &h);

  /// What is required of the finest grid.
  struct GradeRequirements
  {
    unsigned int digits = 0;
    double order = -std::numeric_limits<double>::infinity();
    bool is_limit_certified = false;
  };

  /// @param words  of the command line, each a list: digits=N, order=P, limit=certified
  /// @throws InputError  another word
  GradeRequirements parse_grade_requirements(const std::vector<std::string> &words);

  /// Requirements that do not hold.
  std::vector<std::string> complaints(const GradeRequirements &required, const SeriesGrade &found);
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::GradedLimit> = std::array{
      "converges to the certified solution", "converges to another limit", "cannot be decided"};
} // namespace plumbline::base
