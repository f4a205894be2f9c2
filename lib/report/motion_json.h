#pragma once

#include "study/dynamics.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace plumbline::report
{
  using Json = nlohmann::ordered_json;

  /// Null for what is not finite.
  inline Json known_number(double value)
  {
    return std::isfinite(value) ? Json(value) : Json();
  }

  /// As in dynamics.json.
  Json motion_json(const study::MotionRun &run);
  Json torus_json(const study::TorusEstimate &torus);

  /// What these hold, to the last bit; null is infinity for a critical step, else NaN.
  /// @throws nlohmann::json::exception  a key is missing or of another type
  study::MotionRun motion_from(const Json &json);
  study::TorusEstimate torus_from(const Json &json);
} // namespace plumbline::report
