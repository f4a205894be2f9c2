#include "study/solution_record.h"

#include "base/choice.h"
#include "study/analysis.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  namespace
  {
    const std::string tip_forces = "tip forces";
    constexpr std::size_t n_columns = 7; ///< of that curve

    double value_of(const Record &record, const std::string &scalar, double otherwise)
    {
      return record.has(scalar) ? record[scalar] : otherwise;
    }
  } // namespace

  std::map<std::string, double> errors_of(const Record &record)
  {
    std::map<std::string, double> errors;
    for (const auto &[name, scalar] : record.scalars)
      if (name.find(" | ") != std::string::npos)
        errors[name] = scalar.value;
    return errors;
  }

  double size_of(const Record &record)
  {
    return value_of(record, "variation", 0);
  }

  namespace
  {
    /// A number of the record, or of truncation errors another, in the norm of the error.
    double in_norm_of(const Record &record, const std::string &error, const std::string &scalar,
                      const std::string &of_truncation)
    {
      return norm_of_one(error, area_of(record)) *
             value_of(record, is_truncation(error) ? of_truncation : scalar, 0);
    }
  } // namespace

  double size_of(const Record &record, const std::string &error)
  {
    if (is_energy(error))
      return value_of(record, "energy size", 0);
    return in_norm_of(record, error, "variation", "largest load");
  }

  double round_off_of(const Record &record, const std::string &error)
  {
    if (is_bound(error))
      return value_of(record, "inverse norm", 0) *
             in_norm_of(record, error, "truncation round-off", "");
    if (is_energy(error))
      return value_of(record, "largest energy norm", 0) * value_of(record, "round-off", 0);
    return in_norm_of(record, error, "round-off", "truncation round-off");
  }

  double area_of(const Record &record)
  {
    return value_of(record, "area", 1);
  }

  double geometry_seconds(const Record &record)
  {
    return value_of(record, "geometry seconds", 0);
  }

  void set_weights(Record &record, const Diagnostics &diagnostics)
  {
    if (diagnostics.n_neighbours > 0)
    {
      record.set("neighbours", diagnostics.n_neighbours);
      record.set("smallest weight", diagnostics.smallest_weight_ratio);
    }
    record.set("negative weights", diagnostics.n_negative_weights);
    if (diagnostics.n_conditions > 0)
    {
      record.set("moment conditions", diagnostics.n_conditions);
      record.set("moment rank", diagnostics.rank);
      record.set("smallest singular value", diagnostics.smallest_singular_value);
    }
  }

  void set_limit(Record &record, const LimitProof &limit)
  {
    record.texts["limit"] = base::word(limit.answer);
    record.texts["reason of the limit"] = limit.reason;
    record.set("moment defect", limit.defect);
    record.set("mean moment defect", limit.mean_defect);
    record.set("spread of moments", limit.spread);
    record.set("ball defect", limit.ball_defect);
    record.set("area defect", limit.area_defect);
  }

  LimitProof limit_of(const Record &record)
  {
    LimitProof limit;
    for (const auto answer : {LimitProof::Answer::compatible, LimitProof::Answer::incompatible})
      if (record.text("limit") == base::word(answer))
        limit.answer = answer;
    limit.defect = value_of(record, "moment defect", 0);
    limit.mean_defect = value_of(record, "mean moment defect", 0);
    limit.spread = value_of(record, "spread of moments", 0);
    limit.ball_defect = value_of(record, "ball defect", 0);
    limit.area_defect = value_of(record, "area defect", 0);
    limit.reason = record.text("reason of the limit");
    return limit;
  }

  void set_tip_forces(Record &record, const std::vector<method::TipForce> &forces)
  {
    record.curves.erase(tip_forces);
    if (forces.empty())
      return;
    analysis::Curve curve = {{"tip x", "length", {}},
                             {"tip y", "length", {}},
                             {"force x", "force", {}},
                             {"force y", "force", {}},
                             {"sum of norms", "force", {}},
                             {"F", "force", {}},
                             {"F / sqrt(horizon)", "force/length^(1/2)", {}}};
    for (const method::TipForce &one : forces)
      add_row(curve, {one.tip[0], one.tip[1], one.force[0], one.force[1], one.sum_of_norms,
                      one.norm, one.over_root});
    record.curves[tip_forces] = std::move(curve);
  }

  std::vector<method::TipForce> tip_forces_of(const Record &record)
  {
    const auto found = record.curves.find(tip_forces);
    if (found == record.curves.end() || found->second.size() != n_columns)
      return {};
    const analysis::Curve &curve = found->second;
    std::vector<method::TipForce> forces;
    for (std::size_t i = 0; i < curve.front().values.size(); ++i)
    {
      const auto at = [&](std::size_t column) { return curve.at(column).values.at(i); };
      forces.push_back({{at(0), at(1)}, {at(2), at(3)}, at(4), at(5), at(6)});
    }
    return forces;
  }

  void set_diagnostics(Record &record, const Diagnostics &diagnostics)
  {
    set_weights(record, diagnostics);
    record.set("relative residual", diagnostics.relative_residual);
    record.texts["operator"] = diagnostics.operator_backend;
    record.set("geometry checks", diagnostics.n_geometry_checks);
    record.set("geometry difference", diagnostics.geometry_difference);
    if (diagnostics.is_outer_error_known)
      record.set("outer change", diagnostics.outer_change);
    record.set("outer refinements", diagnostics.n_refinements);
    set_limit(record, diagnostics.limit);
    set_tip_forces(record, diagnostics.tip_forces);
    record.notes = diagnostics.notes;
  }
} // namespace plumbline::study
