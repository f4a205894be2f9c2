#pragma once

#include "base/cost.h"
#include "method/method_family.h"

#include <deal.II/base/point.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace plumbline::analysis
{
  using method::MethodFamily;

  /// Where a record belongs.
  struct Key
  {
    std::string analysis; ///< e.g. "stability"
    std::string method;   ///< e.g. "IPA-AC"
    MethodFamily family = MethodFamily::meshfree;
    std::string problem;       ///< name of the case; empty: the analysis has none
    std::string series;        ///< what is held fixed, e.g. "m = 3"
    std::string variant;       ///< of the method, e.g. "lumped", or a time scheme and its step
    unsigned int level = 0;    ///< from coarse to fine
    double h = 0, horizon = 0; ///< [length]
    double value = 0;          ///< of the parameter that the study varies, where it does

    double m() const { return horizon / h; }
    /// Method and variant, for people.
    std::string label() const { return method + (variant.empty() ? "" : " " + variant); }
    bool is_same_series(const Key &other) const; ///< at whatever level
    bool operator==(const Key &other) const;
  };

  struct Scalar
  {
    double value = 0;
    std::string unit = {}; ///< e.g. "1/time"; empty: none, or that of the problem's data
  };

  struct Column
  {
    std::string name, unit;
    std::vector<double> values;
  };

  /// Columns of equal length, the abscissa first.
  using Curve = std::vector<Column>;

  struct PointField
  {
    unsigned int n_components = 1;
    std::vector<dealii::Point<2>> points; ///< [length]
    std::vector<double> values;           ///< shape (n_points, n_components)
    std::vector<double> areas = {};       ///< of Ω that each point stands for; empty: not known
    std::vector<double> z = {}; ///< of the points in three dimensions; empty: in the plane [length]
  };

  /// What an analysis finds by one method at one point of a study. It describes itself, so that
  /// journal, JSON, tables, charts, expectations and samples need no code for each analysis. Names
  /// are those that people read. What is not known is absent; there is no NaN.
  struct Record
  {
    Key key;
    base::Cost cost;
    std::map<std::string, Scalar> scalars;
    std::map<std::string, std::string> texts; ///< e.g. a classification, or a reason
    std::map<std::string, Curve> curves;
    std::map<std::string, PointField> fields;
    std::vector<std::string> notes;
    std::string failure = {}; ///< empty, or why there are no results

    /// Nothing is entered where the value is not finite.
    void set(const std::string &name, double value, const std::string &unit = "");
    bool has(const std::string &name) const { return scalars.count(name) > 0; }
    /// NaN where it is absent.
    double operator[](const std::string &name) const;
    /// 0 where it is absent: of counts.
    std::size_t count(const std::string &name) const;
    const std::string &text(const std::string &name) const; ///< empty where it is absent
  };

  using Records = std::vector<Record>;
} // namespace plumbline::analysis
