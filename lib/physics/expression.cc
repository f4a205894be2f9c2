#include "physics/expression.h"

#include "base/error.h"
#include "base/text_file.h"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    /// muParser would take 'y = x' for an assignment to y.
    bool has_assignment(const std::string &text)
    {
      const auto is_one_of = [&](std::size_t i, const std::string &set)
      { return i < text.size() && set.find(text[i]) != std::string::npos; };
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '=' && !is_one_of(i + 1, "=") && !(i > 0 && is_one_of(i - 1, "=<>!")))
          return true;
      return false;
    }

    /// Σ_{k=0}^{n} 2^(-γk) cos(2π 2^k x + 1.3 k²), averaged over a width about x: of Hölder
    /// exponent γ up to waves of 2^-n. Not a number for γ <= 0 or an n that is none of 0 ... 30.
    double weierstrass_mean(double x, double gamma, double n, double width)
    {
      constexpr double most_terms = 30;
      if (!(gamma > 0) || !(n >= 0 && n <= most_terms) || n != std::floor(n))
        return std::numeric_limits<double>::quiet_NaN();
      double sum = 0, size = 1, wave = 2 * M_PI;
      for (int k = 0; k <= static_cast<int>(n); ++k)
      {
        const double half = .5 * wave * width, mean = half == 0 ? 1 : std::sin(half) / half;
        sum += size * mean * std::cos(wave * x + 1.3 * k * k);
        size *= std::exp2(-gamma);
        wave *= 2;
      }
      return sum;
    }

    double weierstrass(double x, double gamma, double n)
    {
      return weierstrass_mean(x, gamma, n, 0);
    }

    /// origin + x between two numbers of double precision.
    struct Coordinate
    {
      double nearest = 0, next = 0;
      double beyond = 0; ///< of the way from the one to the other, in [0, 1/2]
    };

    Coordinate scene_coordinate(double origin, double x)
    {
      Coordinate result;
      result.nearest = origin + x;
      // Knuth's sum of two numbers: what rounding has left out, exactly
      const double of_x = result.nearest - origin, of_origin = result.nearest - of_x;
      const double rest = (origin - of_origin) + (x - of_x);
      if (rest == 0)
        return result;
      result.next = std::nextafter(result.nearest, std::copysign(HUGE_VAL, rest));
      result.beyond = rest / (result.next - result.nearest);
      return result;
    }

    /// A name behind a number, as in 200GPa.
    bool is_unit(const mu::ParserError &error)
    {
      const std::string text = error.GetExpr();
      const auto at = static_cast<std::size_t>(error.GetPos());
      std::size_t i = std::min(at, text.size());
      while (i > 0 && text[i - 1] == ' ')
        --i;
      return error.GetPos() > 0 && i > 0 &&
             std::isdigit(static_cast<unsigned char>(text[i - 1])) != 0 &&
             std::isalpha(static_cast<unsigned char>(text[at])) != 0;
    }

    /// What muParser does not understand, in our words.
    std::string reason(const mu::ParserError &error)
    {
      const std::string token = base::shown(error.GetToken());
      const std::string place =
          error.GetPos() < 0 ? "" : " at character " + std::to_string(error.GetPos() + 1);
      const auto about = [&](const std::string &what)
      { return what + (token.empty() ? "" : " '" + token + "'") + place; };
      switch (error.GetCode())
      {
      case mu::ecUNASSIGNABLE_TOKEN:
      case mu::ecINVALID_NAME:
        if (is_unit(error))
          return about("a unit or an unknown name follows a number") +
                 " (numbers have no units: 200 GPa are 200e9 in Pa)";
        return about("there is an unknown name or sign") +
               " (functions are sin, cos, exp, sqrt, abs, ...; z needs Domain/dimension = 3)";
      case mu::ecUNEXPECTED_EOF:
      case mu::ecEMPTY_EXPRESSION:
        return "it ends where a number, a name or a bracket is missing";
      case mu::ecMISSING_PARENS:
        return "a bracket is not closed";
      case mu::ecUNEXPECTED_OPERATOR:
        return about("an operator stands where a value must be,") + " (powers are written x^2)";
      case mu::ecUNEXPECTED_VAL:
      case mu::ecUNEXPECTED_VAR:
      case mu::ecUNEXPECTED_FUN:
        return about("an operator is missing before");
      case mu::ecUNEXPECTED_PARENS:
        return about("there is a bracket too many or an operator too few,");
      case mu::ecUNEXPECTED_ARG_SEP:
      case mu::ecUNEXPECTED_ARG:
        return about("there is a comma outside of a function's arguments,");
      case mu::ecTOO_MANY_PARAMS:
        return about("there are too many arguments of");
      case mu::ecTOO_FEW_PARAMS:
        return about("there are too few arguments of");
      case mu::ecUNEXPECTED_STR:
      case mu::ecSTRING_EXPECTED:
      case mu::ecVAL_EXPECTED:
      case mu::ecUNTERMINATED_STRING:
      case mu::ecSTR_RESULT:
        return "there are quotes, and values are numbers";
      case mu::ecUNEXPECTED_CONDITIONAL:
      case mu::ecMISSING_ELSE_CLAUSE:
      case mu::ecMISPLACED_COLON:
        return "a condition is not of the form a ? b : c";
      case mu::ecINVALID_CHARACTERS_FOUND:
        return "it holds characters other than letters, digits and signs";
      case mu::ecEXPRESSION_TOO_LONG:
      case mu::ecIDENTIFIER_TOO_LONG:
        return "it, or a name in it, is too long";
      default:
        return about("it is no formula");
      }
    }
  } // namespace

  struct Expression::Parsers
  {
    /// A field's value where the expression is being evaluated.
    struct Place
    {
      double value = 0;
      const std::function<double(const Point<2> &)> *field = nullptr;
    };
    double x = 0, y = 0, z = 0;
    std::map<std::string, Place> fields; ///< those that the expression names
    std::vector<mu::Parser> components;
  };

  Expression::Expression(std::string key, std::string text, Names names)
      : key_(std::move(key)), text_(std::move(text)), names_(std::move(names)),
        parsers_(std::make_unique<Parsers>())
  {
    for (const std::string &part : split_outside_brackets(text_, ','))
      try
      {
        if (has_assignment(part))
          throw InputError(key_ + " = '" + part +
                           "' has a single '='; give the expression alone, and compare by '=='");
        mu::Parser parser;
        parser.DefineVar("x", &parsers_->x);
        parser.DefineVar("y", &parsers_->y);
        if (names_.is_in_space)
          parser.DefineVar("z", &parsers_->z);
        parser.DefineConst("pi", M_PI);
        parser.DefineFun("weierstrass", weierstrass);
        parser.DefineFun("weierstrass_mean", weierstrass_mean);
        for (const auto &[name, value] : names_.constants)
          parser.DefineConst(name, value);
        for (const auto &[name, field] : names_.fields)
          parser.DefineVar(name, &parsers_->fields[name].value);
        parser.SetExpr(part);
        parser.Eval();
        for (const auto &[name, field] : names_.fields)
          if (parser.GetUsedVar().count(name) > 0)
            parsers_->fields[name].field = &field;
        parsers_->components.push_back(parser);
      }
      catch (const mu::Parser::exception_type &error)
      {
        std::string names = names_.is_in_space ? "x, y, z, pi" : "x, y, pi";
        for (const auto &constant : names_.constants)
          names += ", " + constant.first;
        for (const auto &field : names_.fields)
          names += ", " + field.first;
        throw InputError(key_ + " = '" + base::shown(part, 200) + "' does not parse: " +
                         reason(error) + "; write a muParser expression in " + names + ".");
      }
    if (!(names_.origin == Point<2>()))
      for (mu::Parser &parser : parsers_->components) // copies do not keep it
        // it would make 3*x - 15000000 of 3*(x - 5000000), which loses the digits of x
        parser.EnableOptimizer(false);
  }

  Expression::Expression(const Expression &other)
      : Expression(other.key_, other.text_, other.names_)
  {
  }

  Expression &Expression::operator=(const Expression &other)
  {
    Expression copy(other);
    std::swap(key_, copy.key_);
    std::swap(text_, copy.text_);
    std::swap(names_, copy.names_); // nodes of maps stay where they are, and pointers to them hold
    std::swap(parsers_, copy.parsers_);
    return *this;
  }

  Expression::~Expression() = default;

  bool Expression::is_constant() const
  {
    return std::all_of(parsers_->components.begin(), parsers_->components.end(),
                       [](const mu::Parser &parser) { return parser.GetUsedVar().empty(); });
  }

  bool Expression::is_piecewise() const
  {
    for (const auto &[name, place] : parsers_->fields)
      if (place.field != nullptr)
        return true;
    if (text_.find_first_of("?<>=!&|") != std::string::npos)
      return true;
    for (const std::string name : {"abs", "min", "max", "sign", "rint"})
      for (std::size_t at = text_.find(name); at != std::string::npos;
           at = text_.find(name, at + 1))
      {
        const auto is_letter = [&](std::size_t i)
        {
          return i < text_.size() &&
                 (std::isalnum(static_cast<unsigned char>(text_[i])) != 0 || text_[i] == '_');
        };
        if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + name.size()))
          return true;
      }
    return false;
  }

  bool Expression::is_smooth() const
  {
    static const std::set<std::string> smooth = {"x",  "y",    "z",    "pi",  "sin", "cos",
                                                 "ln", "sinh", "cosh", "exp", "tanh"};
    for (std::size_t i = 0; i < text_.size();)
    {
      const auto is_of_name = [&](std::size_t k)
      { return k < text_.size() && (std::isalnum(text_[k]) != 0 || text_[k] == '_'); };
      const auto begins_name = [&](std::size_t k)
      { return is_of_name(k) && std::isdigit(text_[k]) == 0; };
      std::size_t end = i + 1;
      if (std::isdigit(text_[i]) != 0 || text_[i] == '.')
      {
        char *last = nullptr;
        std::strtod(&text_[i], &last);
        end = static_cast<std::size_t>(last - text_.data());
      }
      else if (begins_name(i))
      {
        while (is_of_name(end))
          ++end;
        const std::string name = text_.substr(i, end - i);
        if (smooth.count(name) == 0 && names_.constants.count(name) == 0)
          return false;
      }
      else if (text_[i] == '^')
      {
        while (end < text_.size() && (text_[end] == ' ' || std::isdigit(text_[end]) != 0))
          ++end;
        if (text_.find_first_of("0123456789", i) >= end ||
            (end < text_.size() && (is_of_name(end) || text_[end] == '.')))
          return false;
      }
      else if (std::string("+-*/(), \t").find(text_[i]) == std::string::npos)
        return false;
      i = std::max(end, i + 1);
    }
    return true;
  }

  unsigned int Expression::n_components() const
  {
    return static_cast<unsigned int>(parsers_->components.size());
  }

  double Expression::operator()(const Point<2> &x, unsigned int component) const
  {
    if (names_.origin == Point<2>())
      return value_at(x, x, component);
    Point<2> nearest;
    std::array<Coordinate, 2> coordinate;
    for (unsigned int d = 0; d < 2; ++d)
    {
      coordinate[d] = scene_coordinate(names_.origin[d], x[d]);
      nearest[d] = coordinate[d].nearest;
    }
    const double value = value_at(x, nearest, component);
    double result = value;
    for (unsigned int d = 0; d < 2; ++d)
      if (coordinate[d].beyond != 0)
      {
        Point<2> next = nearest;
        next[d] = coordinate[d].next;
        result += coordinate[d].beyond * (value_at(x, next, component) - value);
      }
    return result;
  }

  double Expression::value_at(const Point<2> &x, const Point<2> &in_scene,
                              unsigned int component) const
  {
    for (auto &[name, place] : parsers_->fields)
      if (place.field != nullptr)
        place.value = (*place.field)(x);
    return evaluate(in_scene, component);
  }

  double Expression::at(const Point<3> &x, unsigned int component) const
  {
    return evaluate(x, component);
  }

  template <int dim>
  double Expression::evaluate(const Point<dim> &in_scene, unsigned int component) const
  {
    parsers_->x = in_scene[0];
    parsers_->y = in_scene[1];
    if constexpr (dim == 3)
      parsers_->z = in_scene[2];
    const double value = parsers_->components[component].Eval();
    if (!std::isfinite(value))
    {
      std::ostringstream message;
      if (!(names_.origin == Point<2>()))
        message.precision(std::numeric_limits<double>::digits10);
      message << key_ << " = '" << text_ << "' gives " << value << " at ("
              << (dim == 3 ? "x, y, z" : "x, y") << ") = (" << in_scene[0] << ", " << in_scene[1];
      if constexpr (dim == 3)
        message << ", " << in_scene[2];
      message << "); it must be a finite number in the domain and its collar";
      throw InputError(message.str());
    }
    return value;
  }

  std::vector<std::string> split_outside_brackets(const std::string &text, char separator)
  {
    std::vector<std::string> parts(1);
    int depth = 0;
    for (const char c : text)
    {
      depth += (c == '(' || c == '[') - (c == ')' || c == ']');
      if (c == separator && depth == 0)
        parts.emplace_back();
      else
        parts.back() += c;
    }
    for (std::string &part : parts)
    {
      const auto first = part.find_first_not_of(" \t\n");
      const auto last = part.find_last_not_of(" \t\n");
      part = first == std::string::npos ? "" : part.substr(first, last - first + 1);
    }
    return parts;
  }
} // namespace plumbline::physics
