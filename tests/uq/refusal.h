#pragma once

#include <stdexcept>
#include <string>

/// What an action says that is refused; empty where it is not.
template <class Action>
std::string refusal(const Action &action)
{
  try
  {
    action();
  }
  catch (const std::runtime_error &error)
  {
    return error.what();
  }
  return {};
}
