#pragma once

#include <deal.II/base/point.h>

#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::physics
{
  using dealii::Point;

  /// What expressions may name besides x, y (in space z) and pi.
  struct Names
  {
    bool is_in_space = false;                ///< z is a coordinate
    std::map<std::string, double> constants; ///< for example delta
    /// Fields of the place, whose functions threads may share.
    std::map<std::string, std::function<double(const Point<2> &)>> fields;
    /// Values of x and y at the point (0, 0) [length]: expressions are written in a scene's
    /// coordinates, and take points relative to this one, where those have lost no digits.
    Point<2> origin;

    Names(std::initializer_list<std::pair<const std::string, double>> constants = {})
        : constants(constants)
    {
    }
  };

  /// A vector field R² → R^n_components given by muParser expressions in x and y; in space R³ →
  /// R^n_components, in x, y and z.
  /// Copies share nothing: give each thread its own.
  class Expression
  {
  public:
    /// @param key        the scene key the text comes from, for messages
    /// @param text       one expression a component, separated by commas at depth 0
    /// @throws InputError  an expression that does not parse, with muParser's reason and position
    Expression(std::string key, std::string text, Names names = {});
    Expression(const Expression &other);
    Expression &operator=(const Expression &other);
    ~Expression();

    unsigned int n_components() const;
    const std::string &text() const { return text_; }
    bool is_constant() const; ///< neither x nor y nor a field is in it
    /// Surely smooth wherever it is finite: sums, products, quotients and whole powers of x, y,
    /// constants, sin, cos, exp, ln, sinh, cosh and tanh. Others may be smooth too.
    bool is_smooth() const;

    /// It may be made of pieces: it names a field, a condition or a function that has kinks or
    /// jumps (abs, min, max, sign, rint).
    bool is_piecewise() const;

    /// @param x  relative to Names::origin. Between coordinates that are numbers of double
    /// precision the value is interpolated linearly, so that it is as smooth in x as if there were
    /// all of them
    /// @throws InputError  the value is not a finite number
    double operator()(const Point<2> &x, unsigned int component = 0) const;

    /// In space. @pre Names::is_in_space
    double at(const Point<3> &x, unsigned int component) const;

  private:
    /// @param x  the same point, relative to the origin and in the scene's coordinates
    double value_at(const Point<2> &x, const Point<2> &in_scene, unsigned int component) const;

    /// With the parsers' variables at a place of the scene.
    template <int dim>
    double evaluate(const Point<dim> &in_scene, unsigned int component) const;

    struct Parsers;
    std::string key_, text_;
    Names names_;
    std::unique_ptr<Parsers> parsers_;
  };

  /// Split at a separator, but not inside brackets; each part trimmed.
  std::vector<std::string> split_outside_brackets(const std::string &text, char separator);
} // namespace plumbline::physics
