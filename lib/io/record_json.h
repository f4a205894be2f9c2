#pragma once

#include "analysis/record.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace plumbline::io
{
  /// As results.schema.json describes it. Numbers are written as the shortest decimals that read
  /// back to the same bits.
  nlohmann::ordered_json to_json(const analysis::Record &record);

  /// @param place  of the record, and `file`: both for messages
  /// @throws InputError  a key that is missing, or a value of another type
  analysis::Record record_from_json(const nlohmann::ordered_json &json, const std::string &place,
                                    const std::string &file);
} // namespace plumbline::io
