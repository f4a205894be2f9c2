#pragma once

#include "analysis/record.h"
#include "io/json_archive.h"

// The keys of a record in JSON, each once for both ways, see json_archive.h.
namespace plumbline::base
{
  template <typename Archive>
  void visit(Archive &a, Cost &cost)
  {
    a("setup_seconds", cost.setup_seconds);
    a("solve_seconds", cost.solve_seconds);
    a("peak_bytes", cost.peak_bytes);
    a("n_unknowns", cost.n_unknowns);
    a("n_bonds", cost.n_bonds);
    a("n_iterations", cost.n_iterations);
  }
} // namespace plumbline::base

namespace plumbline::analysis
{
  template <typename Archive>
  void visit(Archive &a, Key &key)
  {
    a("analysis", key.analysis);
    a("method", key.method);
    a("family", key.family);
    a("problem", key.problem);
    a("series", key.series);
    a("variant", key.variant);
    a("level", key.level);
    a("h", key.h);
    a("horizon", key.horizon);
    a("value", key.value);
  }

  template <typename Archive>
  void visit(Archive &a, Scalar &scalar)
  {
    a("value", scalar.value);
    a("unit", scalar.unit);
  }

  template <typename Archive>
  void visit(Archive &a, Column &column)
  {
    a("name", column.name);
    a("unit", column.unit);
    a("values", column.values);
  }

  template <typename Archive>
  void visit(Archive &a, PointField &field)
  {
    std::vector<double> points; // shape (n_points, 2)
    for (const dealii::Point<2> &point : field.points)
      points.insert(points.end(), {point[0], point[1]});
    a("n_components", field.n_components);
    a("points", points);
    a("values", field.values);
    a("areas", field.areas);
    a("z", field.z);
    field.points.resize(points.size() / 2);
    for (std::size_t i = 0; i < field.points.size(); ++i)
      field.points[i] = {points[2 * i], points[2 * i + 1]};
  }

  template <typename Archive>
  void visit(Archive &a, Record &record)
  {
    a("key", record.key);
    a("cost", record.cost);
    a("scalars", record.scalars);
    a("texts", record.texts);
    a("curves", record.curves);
    a("fields", record.fields);
    a("notes", record.notes);
    a("failure", record.failure);
  }
} // namespace plumbline::analysis
