#pragma once

#include <CLI/CLI.hpp>

#include <string>

// Texts about a command that are derived from its parser alone.
namespace plumbline::app
{
  /// The help of the whole command or, of a name, of one of its subcommands; empty: it has none of
  /// this name.
  std::string help_text(const CLI::App &app, const std::string &subcommand);

  /// A script for bash or zsh that completes subcommands, options and file names.
  /// @throws InputError  another shell
  std::string completion(const CLI::App &app, const std::string &shell);

  /// A page for man, of section 1.
  std::string man_page(const CLI::App &app, const std::string &version);
} // namespace plumbline::app
