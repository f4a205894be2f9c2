#include "base/error.h"
#include "bindings.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <cstdlib>
#include <memory>

namespace plumbline::python
{
  namespace py = pybind11;
  using namespace py::literals;

  namespace
  {
    /// MPI for the life of the process, unless somebody else (mpi4py) has started it.
    void start_mpi()
    {
      int is_started = 0;
      MPI_Initialized(&is_started);
      if (is_started != 0)
        return;
      // as the command: no daemon beside it, nor a shared folder
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
      if (getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
        setenv("OMPI_MCA_orte_create_session_dirs", "false", 0);
      static int argc = 1;
      static char name[] = "plumbline";
      static char *names[] = {name, nullptr};
      static char **argv = names;
      static std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
      mpi = std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(
          argc, argv, dealii::numbers::invalid_unsigned_int);
      py::module_::import("atexit").attr("register")(py::cpp_function([] { mpi.reset(); }));
    }

    PyObject *new_error(py::module_ &module, const char *name, const py::tuple &bases,
                        const char *help)
    {
      PyObject *type = PyErr_NewExceptionWithDoc((std::string("plumbline.") + name).c_str(), help,
                                                 bases.ptr(), nullptr);
      if (type == nullptr)
        throw py::error_already_set();
      module.attr(name) = py::reinterpret_borrow<py::object>(type);
      return type;
    }

    PyObject *input_error = nullptr, *numerical_error = nullptr;

    void add_errors(py::module_ &module)
    {
      const auto borrowed = [](PyObject *one) { return py::reinterpret_borrow<py::object>(one); };
      input_error = new_error(module, "InputError", py::make_tuple(borrowed(PyExc_ValueError)),
                              "What was given cannot be used; the message says what is allowed.");
      numerical_error = new_error(
          module, "NumericalError",
          py::make_tuple(borrowed(PyExc_ArithmeticError), borrowed(PyExc_RuntimeError)),
          "The input is sound, but there is no result: no convergence, weights that do not exist.");
      py::register_exception_translator(
          [](std::exception_ptr thrown)
          {
            try
            {
              if (thrown)
                std::rethrow_exception(thrown);
            }
            catch (const InputError &error)
            {
              PyErr_SetString(input_error, error.what());
            }
            catch (const MemoryError &error)
            {
              PyErr_SetString(PyExc_MemoryError, error.what());
            }
            catch (const NumericalError &error)
            {
              PyErr_SetString(numerical_error, error.what());
            }
          });
    }
  } // namespace
} // namespace plumbline::python

PYBIND11_MODULE(_core, module)
{
  using namespace plumbline::python;
  using namespace py::literals;
  dealii::deal_II_exceptions::disable_abort_on_exception();
  start_mpi();
  add_errors(module);
  module.attr("__version__") = PLUMBLINE_VERSION;
  module.def(
      "set_threads",
      [](unsigned int n)
      {
        if (n == 0)
          throw plumbline::InputError("set_threads(0): give a number of threads above 0");
        dealii::MultithreadInfo::set_thread_limit(n);
      },
      "n"_a, "Use at most so many threads; at first there is one for each core.");
  add_kernel(module);
  add_rules(module);
  add_problem(module);
  add_check(module);
  add_matrix(module);
  add_moduli(module);
  add_grade(module);
  add_space(module);
  add_studies(module);
}
