#pragma once

#include "io/json_archive.h"

namespace plumbline::report
{
  using io::Json;
  using io::JsonReader;
  using io::JsonWriter;
} // namespace plumbline::report
