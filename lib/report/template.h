#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace plumbline::report
{
  /// What a template is filled with: texts, lists, objects, and whether something is so. Empty
  /// texts count as what is not there.
  using Data = nlohmann::ordered_json;

  /// A template by its name, of those in templates/: Mustache, where {{text}} is escaped for HTML
  /// and {{{html}}} is not.
  /// @throws std::logic_error  there is none
  const std::string &template_text(const std::string &name);

  /// A template filled in; {{> name}} takes another one.
  /// @throws std::logic_error  it asks for what the data do not have, or is no template
  std::string fill(const std::string &name, const Data &data);

  /// The same of a template that stands elsewhere.
  std::string fill_text(const std::string &text, const Data &data);
} // namespace plumbline::report
