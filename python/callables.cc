#include "callables.h"

#include <array>
#include <cstring>
#include <unordered_map>

namespace plumbline::python
{
  namespace
  {
    struct SamePlace
    {
      std::size_t operator()(const std::array<double, 2> &x) const
      {
        std::array<std::uint64_t, 2> bits{};
        std::memcpy(bits.data(), x.data(), sizeof bits);
        return bits[0] * 0x9e3779b97f4a7c15ULL ^
               (bits[1] + (bits[1] >> 29)) * 0xbf58476d1ce4e5b9ULL;
      }
    };

    /// The values of a function at points, by one call.
    /// @return  shape (n_points, n_components)
    template <int dim>
    std::vector<double> call(const std::string &name, const py::function &function,
                             const std::vector<Point<dim>> &points, unsigned int n_components)
    {
      const py::gil_scoped_acquire lock;
      const auto n = static_cast<py::ssize_t>(points.size());
      py::tuple coordinates(dim);
      for (unsigned int d = 0; d < dim; ++d)
      {
        std::vector<double> along;
        for (const Point<dim> &point : points)
          along.push_back(point[d]);
        coordinates[d] = to_array(std::move(along));
      }
      const py::object given = function(*coordinates);
      const auto refuse = [&](const std::string &found)
      {
        throw InputError(name + ": the function returned " + found + " for " + std::to_string(n) +
                         " points; return " +
                         (n_components == 1   ? "an array of shape (n,)"
                          : n_components == 2 ? "a pair of arrays of shape (n,)"
                                              : "three arrays of shape (n,)") +
                         ", or numbers where they are the same everywhere");
      };
      std::vector<double> values(points.size() * n_components);
      if (n_components > 1 &&
          (!py::isinstance<py::sequence>(given) || py::len(given) != n_components))
        refuse("something else than " + std::to_string(n_components) + " components");
      for (unsigned int c = 0; c < n_components; ++c)
      {
        const py::object one = n_components == 1 ? given : py::object(given[py::int_(c)]);
        const Doubles array = Doubles::ensure(one);
        if (!array)
          throw py::error_already_set();
        if (array.size() != 1 && (array.ndim() != 1 || array.size() != n))
          refuse("an array of shape " + shape_text(array));
        for (std::size_t k = 0; k < points.size(); ++k)
          values[k * n_components + c] = array.data()[array.size() == 1 ? 0 : k];
      }
      return values;
    }

    /// A function by its values at nodes, and elsewhere by a call for each point.
    class Values
    {
    public:
      Values(std::string name, Callable function, unsigned int n_components,
             const std::vector<Point<2>> &nodes)
          : name_(std::move(name)), function_(std::move(function)), n_components_(n_components),
            at_nodes_(call(name_, *function_, nodes, n_components))
      {
        index_.reserve(nodes.size());
        for (std::size_t k = 0; k < nodes.size(); ++k)
          index_.emplace(std::array<double, 2>{nodes[k][0], nodes[k][1]}, k);
      }

      double operator()(const Point<2> &x, unsigned int component) const
      {
        if (const auto node = index_.find({x[0], x[1]}); node != index_.end())
          return at_nodes_[node->second * n_components_ + component];
        return call<2>(name_, *function_, {x}, n_components_)[component];
      }

    private:
      std::string name_;
      Callable function_;
      unsigned int n_components_;
      std::vector<double> at_nodes_;
      std::unordered_map<std::array<double, 2>, std::size_t, SamePlace> index_;
    };
  } // namespace

  Callable share(py::function function)
  {
    return Callable(new py::function(std::move(function)),
                    [](const py::function *one)
                    {
                      const py::gil_scoped_acquire lock;
                      delete one;
                    });
  }

  GivenField::GivenField(std::string name, const py::object &given) : name_(std::move(name))
  {
    if (given.is_none())
      return;
    if (py::isinstance<py::str>(given))
      text_ = given.cast<std::string>();
    else if (py::isinstance<py::function>(given) || PyCallable_Check(given.ptr()) != 0)
      function_ = share(py::reinterpret_borrow<py::function>(given));
    else if (py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given))
      text_ = py::str(py::float_(given)).cast<std::string>();
    else
      throw InputError(name_ + " = " + py::repr(given).cast<std::string>() +
                       " is no field; give an expression in x and y ('sin(3*x)'; 'x, y' of two "
                       "components), a function f(x, y) of arrays, or a number");
  }

  physics::Expression GivenField::expression(unsigned int n_components, double horizon,
                                             bool is_in_space) const
  {
    physics::Names names = {{"delta", horizon}};
    names.is_in_space = is_in_space;
    physics::Expression expression(name_, *text_, names);
    if (expression.n_components() != n_components)
      throw InputError(name_ + " = '" + *text_ + "' has " +
                       std::to_string(expression.n_components()) +
                       " components, but the kernel couples " + std::to_string(n_components) +
                       "; give as many, separated by commas");
    return expression;
  }

  problem::Field<2> GivenField::field(unsigned int n_components, double horizon,
                                      const std::vector<Point<2>> &nodes) const
  {
    problem::Field<2> result;
    if (text_)
    {
      const physics::Expression given = expression(n_components, horizon, false);
      result.value = given;
      result.is_piecewise = given.is_piecewise();
    }
    else if (function_)
    {
      const auto values = std::make_shared<const Values>(name_, function_, n_components, nodes);
      result.value = [values](const Point<2> &x, unsigned int component)
      { return (*values)(x, component); };
    }
    return result;
  }

  problem::Field<3> GivenField::field_in_space(unsigned int n_components, double horizon) const
  {
    problem::Field<3> result;
    if (text_)
    {
      const physics::Expression given = expression(n_components, horizon, true);
      result.value = [given](const Point<3> &x, unsigned int component)
      { return given.at(x, component); };
      result.is_piecewise = given.is_piecewise();
    }
    else if (function_)
      result.value = [name = name_, function = function_, n_components](const Point<3> &x,
                                                                        unsigned int component)
      { return call<3>(name, *function, {x}, n_components)[component]; };
    return result;
  }

  physics::Coefficient GivenField::coefficient(double horizon, const std::vector<Point<2>> &nodes,
                                               physics::Mean mean) const
  {
    if (text_)
      return {physics::Expression(name_, *text_, {{"delta", horizon}}), mean};
    const auto value = field(1, horizon, nodes).value;
    return {[value](const Point<2> &x) { return value(x, 0); }, name_, mean};
  }
} // namespace plumbline::python
