#pragma once

#include <pybind11/pybind11.h>

// What the module is made of, each part in a source of its own.
namespace plumbline::python
{
  void add_kernel(pybind11::module_ &module);
  void add_rules(pybind11::module_ &module);
  void add_problem(pybind11::module_ &module);
  void add_check(pybind11::module_ &module);
  void add_matrix(pybind11::module_ &module);
  void add_moduli(pybind11::module_ &module);
  void add_grade(pybind11::module_ &module);
  void add_space(pybind11::module_ &module);
  void add_studies(pybind11::module_ &module);
} // namespace plumbline::python
