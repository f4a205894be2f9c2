#include "physics/taylor_expression.h"

#include "base/error.h"
#include "base/text_file.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

namespace plumbline::physics
{
  namespace
  {
    using Step = TaylorExpression::Step;

    Taylor add(const Taylor &a, const Taylor &b)
    {
      return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
    }

    Taylor negate(const Taylor &a)
    {
      return {-a[0], -a[1], -a[2], -a[3]};
    }

    Taylor subtract(const Taylor &a, const Taylor &b)
    {
      return add(a, negate(b));
    }

    Taylor multiply(const Taylor &a, const Taylor &b)
    {
      Taylor product{};
      for (unsigned int i = 0; i < product.size(); ++i)
        for (unsigned int k = 0; k <= i; ++k)
          product[i] += a[k] * b[i - k];
      return product;
    }

    Taylor divide(const Taylor &a, const Taylor &b)
    {
      Taylor quotient{};
      for (unsigned int i = 0; i < quotient.size(); ++i)
      {
        double rest = a[i];
        for (unsigned int k = 0; k < i; ++k)
          rest -= quotient[k] * b[i - k];
        quotient[i] = rest / b[0];
      }
      return quotient;
    }

    /// g(a) of the Taylor coefficients of g at a[0].
    Taylor compose(const Taylor &g, const Taylor &a)
    {
      return {g[0], g[1] * a[1], g[1] * a[2] + g[2] * a[1] * a[1],
              g[1] * a[3] + 2 * g[2] * a[1] * a[2] + g[3] * a[1] * a[1] * a[1]};
    }

    Taylor exponential(const Taylor &a)
    {
      const double value = std::exp(a[0]);
      return compose({value, value, value / 2, value / 6}, a);
    }

    Taylor logarithm(const Taylor &a)
    {
      const double x = a[0];
      return compose({std::log(x), 1 / x, -1 / (2 * x * x), 1 / (3 * x * x * x)}, a);
    }

    Taylor power_of(const Taylor &a, double exponent)
    {
      Taylor g{};
      double binomial = 1;
      for (unsigned int i = 0; i < g.size(); ++i)
      {
        g[i] = binomial == 0 ? 0 : binomial * std::pow(a[0], exponent - i);
        binomial *= (exponent - i) / (i + 1);
      }
      return compose(g, a);
    }

    Taylor power(const Taylor &a, const Taylor &b)
    {
      const bool is_constant = b[1] == 0 && b[2] == 0 && b[3] == 0;
      return is_constant ? power_of(a, b[0]) : exponential(multiply(b, logarithm(a)));
    }

    Taylor root(const Taylor &a)
    {
      return power_of(a, .5);
    }

    Taylor sine(const Taylor &a)
    {
      const double s = std::sin(a[0]), c = std::cos(a[0]);
      return compose({s, c, -s / 2, -c / 6}, a);
    }

    Taylor cosine(const Taylor &a)
    {
      const double s = std::sin(a[0]), c = std::cos(a[0]);
      return compose({c, -s, -c / 2, s / 6}, a);
    }

    Taylor hyperbolic_sine(const Taylor &a)
    {
      const double s = std::sinh(a[0]), c = std::cosh(a[0]);
      return compose({s, c, s / 2, c / 6}, a);
    }

    Taylor hyperbolic_cosine(const Taylor &a)
    {
      const double s = std::sinh(a[0]), c = std::cosh(a[0]);
      return compose({c, s, c / 2, s / 6}, a);
    }

    Taylor hyperbolic_tangent(const Taylor &a)
    {
      // 1 - tanh² without cancellation; 0 where cosh overflows
      const double t = std::tanh(a[0]), c = std::cosh(a[0]), d = 1 / c / c;
      return compose({t, d, -t * d, d * (3 * t * t - 1) / 3}, a);
    }

    Taylor arc_tangent(const Taylor &a)
    {
      const double d = 1 / (1 + a[0] * a[0]);
      return compose({std::atan(a[0]), d, -a[0] * d * d, d * d * d * (3 * a[0] * a[0] - 1) / 3}, a);
    }

    using Function = Taylor (*)(const Taylor &);

    const std::map<std::string, Function> &functions()
    {
      static const std::map<std::string, Function> all = {{"exp", exponential},
                                                          {"ln", logarithm},
                                                          {"sqrt", root},
                                                          {"sin", sine},
                                                          {"cos", cosine},
                                                          {"atan", arc_tangent},
                                                          {"sinh", hyperbolic_sine},
                                                          {"cosh", hyperbolic_cosine},
                                                          {"tanh", hyperbolic_tangent}};
      return all;
    }

    const std::map<std::string, Step> &operands()
    {
      static const std::map<std::string, Step> all = {{"r", {0, true, nullptr, nullptr}},
                                                      {"pi", {M_PI, false, nullptr, nullptr}}};
      return all;
    }

    /// Recursive descent: sums of products of signed powers.
    class Parser
    {
    public:
      Parser(const std::string &key, const std::string &text) : key_(key), text_(text) {}

      std::vector<Step> parse()
      {
        constexpr std::size_t longest = 1000; // brackets nest no deeper
        if (text_.size() > longest)
          fail("it is longer than " + std::to_string(longest) + " characters");
        sum();
        if (next() != '\0')
          fail("an operator is missing before '" + text_.substr(at_, 1) + "'");
        return std::move(steps_);
      }

    private:
      [[noreturn]] void fail(const std::string &reason) const
      {
        std::string names;
        for (const auto &function : functions())
          names += ", " + function.first;
        throw InputError(
            key_ + " = '" + base::shown(text_, 200) + "' does not parse at character " +
            std::to_string(at_ + 1) + ": " + reason +
            "; write an expression in r with numbers, +, -, *, /, ^, brackets, pi" + names);
      }

      /// The next character that is not blank; '\0' at the end.
      char next()
      {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
          ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
      }

      bool takes(char c)
      {
        if (next() != c)
          return false;
        ++at_;
        return true;
      }

      void push(Taylor (*binary)(const Taylor &, const Taylor &))
      {
        steps_.push_back({0, false, nullptr, binary});
      }

      void sum()
      {
        product();
        while (next() == '+' || next() == '-')
        {
          const bool is_sum = takes('+') || !takes('-');
          product();
          push(is_sum ? add : subtract);
        }
      }

      void product()
      {
        factor();
        while (next() == '*' || next() == '/')
        {
          const bool is_product = takes('*') || !takes('/');
          factor();
          push(is_product ? multiply : divide);
        }
      }

      void factor()
      {
        if (takes('-'))
        {
          factor();
          steps_.push_back({0, false, negate, nullptr});
          return;
        }
        if (takes('+'))
          return factor();
        operand();
        if (takes('^'))
        {
          factor();
          push(power);
        }
      }

      void operand()
      {
        const char c = next();
        if (takes('('))
        {
          sum();
          if (!takes(')'))
            fail("a bracket is not closed");
        }
        else if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.')
        {
          char *end = nullptr;
          const double value = std::strtod(text_.c_str() + at_, &end);
          if (end == text_.c_str() + at_)
            fail("a number is missing");
          at_ = static_cast<std::size_t>(end - text_.c_str());
          steps_.push_back({value, false, nullptr, nullptr});
        }
        else if (std::isalpha(static_cast<unsigned char>(c)) != 0)
          name();
        else
          fail("a number, a name or a bracket is missing");
      }

      void name()
      {
        std::size_t end = at_;
        while (end < text_.size() && std::isalnum(static_cast<unsigned char>(text_[end])) != 0)
          ++end;
        const std::string name = text_.substr(at_, end - at_);
        const auto function = functions().find(name);
        const auto operand_of = operands().find(name);
        if (operand_of == operands().end() && function == functions().end())
          fail("there is an unknown name '" + name + "'");
        at_ = end;
        if (operand_of != operands().end())
        {
          steps_.push_back(operand_of->second);
          return;
        }
        if (next() != '(')
          fail("'(' is missing after " + name);
        operand();
        steps_.push_back({0, false, function->second, nullptr});
      }

      const std::string &key_, &text_;
      std::size_t at_ = 0;
      std::vector<Step> steps_;
    };
  } // namespace

  TaylorExpression::TaylorExpression(const std::string &key, const std::string &text)
      : steps_(Parser(key, text).parse())
  {
  }

  Taylor TaylorExpression::operator()(double r) const
  {
    std::vector<Taylor> results;
    for (const Step &step : steps_)
      if (step.unary != nullptr)
        results.back() = step.unary(results.back());
      else if (step.binary != nullptr)
      {
        const Taylor right = results.back();
        results.pop_back();
        results.back() = step.binary(results.back(), right);
      }
      else
        results.push_back(step.is_variable ? Taylor{r, 1, 0, 0} : Taylor{step.constant, 0, 0, 0});
    return results.front();
  }
} // namespace plumbline::physics
