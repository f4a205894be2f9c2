#include "scene/keys.h"

#include "base/error.h"
#include "base/number_text.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "physics/expression.h"
#include "scene/aliases.h"
#include "scene/on_line.h"
#include "scene/values.h"

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace plumbline::scene
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /// A pattern with a readable description of the allowed values.
    template <class Pattern>
    class InWords : public Pattern
    {
    public:
      template <class... Arguments>
      explicit InWords(std::string words, const Arguments &...arguments)
          : Pattern(arguments...), words_(std::move(words))
      {
      }

      std::string description(Patterns::PatternBase::OutputStyle) const override { return words_; }
      std::unique_ptr<Patterns::PatternBase> clone() const override
      {
        return std::make_unique<InWords>(*this);
      }

    private:
      std::string words_;
    };

    /// Numbers or words separated by ','. deal.II accepts a trailing ',', which is likely an error.
    class CommaList : public InWords<Patterns::List>
    {
    public:
      using InWords<Patterns::List>::InWords;

      bool match(const std::string &text) const override
      {
        const auto last = text.find_last_not_of(' ');
        return List::match(text) && (last == std::string::npos || text[last] != ',');
      }
      std::unique_ptr<PatternBase> clone() const override
      {
        return std::make_unique<CommaList>(*this);
      }
    };

    /// One of some words, in any case.
    class Choice : public InWords<Patterns::Selection>
    {
    public:
      explicit Choice(const std::vector<std::string> &words)
          : InWords<Patterns::Selection>("one of " + join(words, ", "), join(words, "|")),
            words_(words)
      {
      }
      std::unique_ptr<PatternBase> clone() const override
      {
        return std::make_unique<Choice>(*this);
      }
      const std::vector<std::string> &words() const { return words_; }

      /// The word as it is declared, or the text that is none.
      std::string declared(const std::string &text) const
      {
        if (match(text))
          return text;
        std::string found = text;
        for (const std::string &word : words_)
          if (base::to_lower(word) == base::to_lower(text))
          {
            if (found != text)
              return text; // two words differ in their case alone
            found = word;
          }
        return found;
      }

    private:
      std::vector<std::string> words_;
    };

    constexpr double least_positive = 1e-300;
    constexpr unsigned int any_length = std::numeric_limits<unsigned int>::max();

    Patterns::List polyline(unsigned int most_points)
    {
      const CommaList point("'x, y'", Patterns::Double(), 2, 2, ",");
      return {point, 2, most_points, ":"};
    }

    Allowed polylines(const std::string &words, unsigned int most_points)
    {
      return std::make_shared<InWords<Patterns::List>>(words, polyline(most_points), 0, any_length,
                                                       ";");
    }

    /// The first corner has three coordinates.
    bool are_in_space(const std::string &boxes)
    {
      const auto first = boxes.begin(),
                 last =
                     first + static_cast<std::ptrdiff_t>(std::min(boxes.find(':'), boxes.size()));
      return std::count(first, last, ',') == 2;
    }

    /// Boxes in the plane; what is said of boxes in space is read by to_cuboids.
    class AnyBoxes : public InWords<Patterns::List>
    {
    public:
      AnyBoxes()
          : InWords<Patterns::List>("boxes 'x0, y0 : x1, y1' separated by ';' (in three dimensions "
                                    "'x0, y0, z0 : x1, y1, z1', in one 'x0 : x1')",
                                    polyline(2), 0, any_length, ";")
      {
      }
      bool match(const std::string &text) const override
      {
        return are_in_space(text) || are_on_line(text) || List::match(text);
      }
      std::unique_ptr<PatternBase> clone() const override
      {
        return std::make_unique<AnyBoxes>(*this);
      }
    };

    bool is_list(const Patterns::PatternBase &allowed)
    {
      return dynamic_cast<const Patterns::List *>(&allowed) != nullptr;
    }

    /// The words of a key that takes one of them, or a list of some.
    const Choice *choice_of(const Patterns::PatternBase &allowed)
    {
      const auto *list = dynamic_cast<const CommaList *>(&allowed);
      return dynamic_cast<const Choice *>(list == nullptr ? &allowed : &list->get_base_pattern());
    }

    /// A word of a choice that the text may stand for.
    std::string word_hint(const std::string &text, const Patterns::PatternBase &allowed)
    {
      const Choice *const choice = choice_of(allowed);
      return choice == nullptr ? "" : base::did_you_mean(text, choice->words());
    }

    /// Of one box or line whose corners have no ':' between them.
    std::string corner_hint(const std::string &text, const Patterns::PatternBase &allowed)
    {
      const auto *all = dynamic_cast<const Patterns::List *>(&allowed);
      const auto *corners =
          all == nullptr ? nullptr : dynamic_cast<const Patterns::List *>(&all->get_base_pattern());
      const std::vector<std::string> given = dealii::Utilities::split_string_list(text, ",");
      const Patterns::Double number;
      if (corners == nullptr || corners->get_separator().front() != ':' ||
          (given.size() != 4 && given.size() != 6) ||
          !std::all_of(given.begin(), given.end(),
                       [&](const std::string &one) { return number.match(one); }))
        return "";
      const auto middle = given.begin() + static_cast<std::ptrdiff_t>(given.size() / 2);
      return "; did you mean '" + join({given.begin(), middle}, ", ") + " : " +
             join({middle, given.end()}, ", ") + "'?";
    }

    /// The part of a list that is not allowed; else the whole text.
    std::string culprit(const std::string &text, const Patterns::PatternBase &allowed)
    {
      if (const auto *list = dynamic_cast<const Patterns::List *>(&allowed))
        for (const std::string &part :
             dealii::Utilities::split_string_list(text, list->get_separator()))
          if (!list->get_base_pattern().match(part))
            return culprit(part, list->get_base_pattern());
      return text;
    }
  } // namespace

  namespace
  {
    /// A fraction of two numbers, as 1/12, as the shortest decimal that is the same number; any
    /// other text as it is.
    std::string without_fraction(const std::string &text)
    {
      const Patterns::Double number;
      const auto slash = text.find('/');
      if (slash == std::string::npos)
        return text;
      const std::string over = trim(text.substr(0, slash)), under = trim(text.substr(slash + 1));
      if (!number.match(over) || !number.match(under) || to_number(under) == 0)
        return text;
      const double value = to_number(over) / to_number(under);
      constexpr int fewest = 15, always_enough = 17; // digits of a double
      int n_digits = fewest;
      while (n_digits < always_enough && to_number(base::to_text(value, n_digits)) != value)
        ++n_digits;
      return base::to_text(value, n_digits);
    }

    /// A list separated by ',' whose parts are changed.
    std::string changed_parts(const std::string &text,
                              const std::function<std::string(const std::string &)> &changed)
    {
      std::vector<std::string> parts = physics::split_outside_brackets(text, ',');
      std::transform(parts.begin(), parts.end(), parts.begin(), changed);
      return join(parts, ", ");
    }

    /// A value as its key is to have it: words as they are declared, numbers without fractions.
    std::string normalised(const std::string &text, const Patterns::PatternBase &allowed)
    {
      if (const auto *choice = dynamic_cast<const Choice *>(&allowed))
        return choice->declared(text);
      const Choice *const words = choice_of(allowed); // of a list
      if (allowed.match(text) || (words == nullptr && text.find('/') == std::string::npos))
        return text;
      if (dynamic_cast<const Patterns::Double *>(&allowed) != nullptr)
        return without_fraction(text);
      if (dynamic_cast<const CommaList *>(&allowed) == nullptr)
        return text;
      const std::string changed = changed_parts(
          text, [&](const std::string &part)
          { return words == nullptr ? without_fraction(part) : words->declared(part); });
      return allowed.match(changed) ? changed : text; // the message has the text that was given
    }
  } // namespace

  Allowed any_text()
  {
    return std::make_shared<InWords<Patterns::Anything>>("any text");
  }

  Allowed yes_or_no()
  {
    return std::make_shared<InWords<Patterns::Bool>>("true or false");
  }

  Allowed one_of(const std::vector<std::string> &words)
  {
    return std::make_shared<Choice>(words);
  }

  Allowed some_of(const std::vector<std::string> &words)
  {
    return std::make_shared<CommaList>("one or more of " + join(words, ", ") + ", separated by ','",
                                       Choice(words), 1, any_length, ",");
  }

  Allowed count(int lowest, int highest)
  {
    return std::make_shared<InWords<Patterns::Integer>>(
        "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest), lowest,
        highest);
  }

  Allowed any_number()
  {
    return std::make_shared<InWords<Patterns::Double>>("a number such as 0.5 or 1e-3");
  }

  Allowed positive()
  {
    return std::make_shared<InWords<Patterns::Double>>("a number above 0 such as 0.5 or 1e-3",
                                                       least_positive);
  }

  Allowed between(double lowest, double highest)
  {
    return std::make_shared<InWords<Patterns::Double>>(
        "a number from " + short_number(lowest) + " to " + short_number(highest), lowest, highest);
  }

  Allowed numbers()
  {
    return std::make_shared<CommaList>("numbers such as 0.05 or 1e-3, separated by ','",
                                       Patterns::Double(), 0, any_length, ",");
  }

  Allowed positive_numbers()
  {
    return std::make_shared<CommaList>("numbers above 0 such as 0.05 or 1e-3, separated by ','",
                                       Patterns::Double(least_positive), 0, any_length, ",");
  }

  Allowed boxes()
  {
    return polylines("boxes 'x0, y0 : x1, y1' separated by ';'", 2);
  }

  Allowed any_boxes()
  {
    return std::make_shared<AnyBoxes>();
  }

  Allowed lines()
  {
    return polylines("lines 'x0, y0 : x1, y1', with more points if they bend, separated by ';'",
                     any_length);
  }

  std::vector<std::vector<dealii::Point<2>>> to_lines(const std::string &text,
                                                      const Allowed &allowed)
  {
    if (!allowed->match(text))
      throw InputError("'" + base::shown(text) + "' is not allowed; write " +
                       allowed->description());
    return Patterns::Tools::Convert<std::vector<std::vector<dealii::Point<2>>>>::to_value(text,
                                                                                          *allowed);
  }

  std::vector<geometry::Box> to_boxes(const std::string &text)
  {
    std::vector<geometry::Box> result;
    for (const auto &corners : to_lines(text, boxes()))
    {
      if (!(corners[0][0] < corners[1][0]) || !(corners[0][1] < corners[1][1]))
        throw InputError("a box of '" + text +
                         "' is empty; its second corner must be above and right of its first");
      result.push_back({corners[0], corners[1]});
    }
    return result;
  }

  std::vector<geometry::Cuboid> to_cuboids(const std::string &text)
  {
    std::vector<geometry::Cuboid> result;
    if (!are_in_space(text))
      return result;
    for (const std::string &box : physics::split_outside_brackets(text, ';'))
    {
      const auto corners = physics::split_outside_brackets(box, ':');
      const auto wrong = [&](const std::string &reason)
      {
        return InputError(
            "box '" + base::shown(box) + "' " + reason +
            "; write 'x0, y0 : x1, y1', in three dimensions 'x0, y0, z0 : x1, y1, z1', with "
            "increasing coordinates, and ';' between boxes");
      };
      if (corners.size() != 2)
        throw wrong("does not have two corners");
      geometry::Cuboid cuboid;
      for (const bool is_upper : {false, true})
      {
        const auto words = physics::split_outside_brackets(corners[is_upper ? 1 : 0], ',');
        if (words.size() != 3)
          throw wrong("has a corner without three coordinates");
        for (unsigned int d = 0; d < 3; ++d)
          (is_upper ? cuboid.upper : cuboid.lower)[d] = to_number(without_fraction(words[d]));
      }
      for (unsigned int d = 0; d < 3; ++d)
        if (!(cuboid.lower[d] < cuboid.upper[d]))
          throw wrong("is empty");
      result.push_back(cuboid);
    }
    return result;
  }

  bool are_on_line(const std::string &boxes)
  {
    const std::size_t colon = boxes.find(':');
    return colon != std::string::npos && boxes.find(',') > colon;
  }

  std::vector<geometry::Box> to_intervals(const std::string &text)
  {
    std::vector<geometry::Box> result;
    for (const std::string &interval : physics::split_outside_brackets(text, ';'))
    {
      const auto ends = physics::split_outside_brackets(interval, ':');
      const auto wrong = [&](const std::string &reason)
      {
        return InputError("interval '" + base::shown(interval) + "' " + reason +
                          "; write 'x0 : x1' with x0 < x1, and ';' between intervals");
      };
      if (ends.size() != 2)
        throw wrong("does not have two ends");
      if (interval.find(',') != std::string::npos)
        throw wrong("has an end with more than one coordinate");
      const double lower = to_number(without_fraction(ends[0])),
                   upper = to_number(without_fraction(ends[1]));
      if (!(lower < upper))
        throw wrong("is empty");
      result.push_back({dealii::Point<2>(lower, 0), dealii::Point<2>(upper, 0)});
    }
    return result;
  }

  Keys::Keys() : parameters_(std::make_unique<dealii::ParameterHandler>()) {}
  Keys::~Keys() = default;

  void Keys::enter(const std::string &section)
  {
    if (!section_.empty())
      parameters_->leave_subsection();
    if (!section.empty())
      parameters_->enter_subsection(section);
    section_ = section;
  }

  void Keys::remember(const std::string &name, const Allowed &allowed, const std::string &help)
  {
    keys_.push_back({section_, name, parameters_->get(name), allowed, help});
  }

  template <class T>
  void Keys::add(const std::string &name, T &member, const Allowed &allowed,
                 const std::string &help)
  {
    parameters_->add_parameter(name, member, help, *allowed);
    remember(name, allowed, help);
  }

  template void Keys::add(const std::string &, double &, const Allowed &, const std::string &);
  template void Keys::add(const std::string &, bool &, const Allowed &, const std::string &);
  template void Keys::add(const std::string &, int &, const Allowed &, const std::string &);
  template void Keys::add(const std::string &, unsigned int &, const Allowed &,
                          const std::string &);
  template void Keys::add(const std::string &, std::string &, const Allowed &, const std::string &);
  template void Keys::add(const std::string &, std::vector<double> &, const Allowed &,
                          const std::string &);

  void Keys::add(const std::string &name, std::string &member, const std::string &help)
  {
    add(name, member, any_text(), help);
  }

  void Keys::add(const std::string &name, bool &member, const std::string &if_false,
                 const std::string &if_true, const std::string &help)
  {
    const std::string by_default = member ? if_true : if_false;
    add(
        name, by_default, one_of({by_default, member ? if_false : if_true}),
        [&member, if_true](const std::string &text) { member = text == if_true; }, help);
  }

  void Keys::add(const std::string &name, const std::string &by_default, const Allowed &allowed,
                 const Read &read, const std::string &help)
  {
    parameters_->declare_entry(name, by_default, *allowed, help);
    parameters_->add_action(name, read);
    remember(name, allowed, help);
  }

  std::vector<const Keys::Key *> Keys::matches(const std::string &path) const
  {
    const std::string current = current_key(path), given = base::to_lower(path);
    std::vector<const Key *> found;
    for (const Key &key : keys_)
    {
      if (key.path() == current)
        return {&key};
      if (base::to_lower(key.path()) == given || base::to_lower(key.name) == given ||
          current_key(key.section + "/" + path) == key.path())
        found.push_back(&key);
    }
    return found;
  }

  const Keys::Key &Keys::find(const std::string &path) const
  {
    const std::vector<const Key *> found = matches(path);
    if (found.size() != 1)
      refuse(path);
    return *found[0];
  }

  void Keys::refuse(const std::string &path) const
  {
    const std::string section = base::to_lower(path.substr(0, path.find('/')));
    std::vector<std::string> alike, every, sections;
    for (const Key *key : matches(path))
      alike.push_back(key->path());
    const bool is_ambiguous = !alike.empty();
    for (const Key &key : keys_)
    {
      every.push_back(path.find('/') == std::string::npos ? key.name : key.path());
      if (!is_ambiguous && base::to_lower(key.section) == section)
        alike.push_back(key.path());
      if (!key.section.empty() && (sections.empty() || sections.back() != key.section))
        sections.push_back(key.section);
    }
    std::vector<std::string> meant;
    for (const std::string &similar : base::similar_words(path, every))
      for (const Key *key : matches(similar))
        if (std::find(meant.begin(), meant.end(), key->path()) == meant.end())
          meant.push_back(key->path());
    const std::string no_section =
        path.find('/') == std::string::npos
            ? ""
            : ": there is no section '" + base::shown(path.substr(0, path.find('/'))) + "'";
    throw InputError(
        "key '" + base::shown(path) + "' is " +
        (is_ambiguous ? "in several sections" : "not known") +
        (alike.empty()
             ? no_section + "; the sections are " + join(sections, ", ") +
                   "; 'plumbline describe WORD' lists the keys whose name or help contains WORD"
             : "; write one of: " + join(alike, ", ")) +
        (is_ambiguous ? "" : base::did_you_mean(meant)));
  }

  std::string Keys::name_of(const std::string &path) const
  {
    const std::vector<const Key *> found = matches(path);
    return found.size() == 1 ? found[0]->path() : path;
  }

  void Keys::set(const std::string &path, const std::string &given_value)
  {
    Key &key = keys_[static_cast<std::size_t>(&find(path) - keys_.data())];
    const std::string value = normalised(current_value(key.path(), given_value), *key.allowed);
    const std::string given = path + " = '" + base::shown(value) + "' ";
    const bool is_text =
        std::none_of(value.begin(), value.end(),
                     [](unsigned char c) { return c == '#' || c == 127 || (c < 32 && c != '\t'); });
    if (!is_text || (!value.empty() && value.back() == '\\'))
      throw InputError(
          given + "cannot be written in a scene: '#' begins a comment, a '\\' at the end continues "
                  "the line; remove these, line breaks and other control characters");
    if (const std::string hint = comma_hint(value, Comma::before_0);
        !hint.empty() && !key.section.empty())
      throw InputError(given + "is not allowed" + hint);
    const std::string bad = culprit(value, *key.allowed);
    const std::string corners = corner_hint(value, *key.allowed);
    if (!key.allowed->match(value))
      throw InputError(given + "is not allowed" +
                       (bad == value ? "" : ", for '" + base::shown(bad) + "' in it") + "; write " +
                       key.allowed->description() + ", or remove the key: its default is '" +
                       key.by_default + "'" +
                       (corners.empty()
                            ? comma_hint(value, is_list(*key.allowed) ? Comma::after_0 : Comma::any)
                            : corners) +
                       word_hint(bad, *key.allowed));
    key.value = value;
    key.is_given = true;
    enter(key.section);
    try
    {
      parameters_->set(key.name, value);
    }
    catch (const InputError &error)
    {
      throw InputError(path + ": " + error.what());
    }
  }

  bool Keys::is_changed(const Key &key)
  {
    if (!key.is_given || key.value == key.by_default)
      return false;
    const Patterns::Double number;
    return !number.match(key.value) || !number.match(key.by_default) ||
           to_number(key.value) != to_number(key.by_default);
  }

  std::vector<std::string> Keys::changed_keys(const std::string &section) const
  {
    std::vector<std::string> result;
    for (const Key &key : keys_)
      if (key.section == section && is_changed(key))
        result.push_back(key.path());
    return result;
  }

  std::string Keys::value(const std::string &path) const
  {
    const Key &key = find(path);
    return key.is_given ? key.value : key.by_default;
  }

  std::string Keys::Key::description() const
  {
    return path() + "\n  " + help +
           "\n  default: " + (by_default.empty() ? "(empty)" : by_default) +
           "\n  allowed: " + allowed->description() + "\n";
  }

  namespace
  {
    /// Words of a search in small letters; what is left of "'s" is none.
    std::vector<std::string> words_of(const std::string &text)
    {
      std::vector<std::string> words(1);
      for (const unsigned char c : base::to_lower(text))
        if (std::isalnum(c) != 0 || c >= 128)
          words.back() += static_cast<char>(c);
        else
          words.emplace_back();
      words.erase(std::remove_if(words.begin(), words.end(),
                                 [](const std::string &word) { return word.size() < 2; }),
                  words.end());
      return words;
    }

    /// How well words fit a text: for each of them 2 where a word of it begins so, 1 elsewhere in
    /// it.
    int rank(const std::string &word, const std::string &text)
    {
      const std::vector<std::string> all = words_of(text);
      const bool begins = std::any_of(
          all.begin(), all.end(), [&](const std::string &one) { return one.rfind(word, 0) == 0; });
      return begins ? 2 : base::to_lower(text).find(word) != std::string::npos ? 1 : 0;
    }
  } // namespace

  std::string Keys::search(const std::string &text) const
  {
    const std::vector<std::string> words = words_of(text);
    std::vector<std::pair<int, const Key *>> found;
    int most_words = 0; // of the words, that a key has
    for (const Key &key : keys_)
    {
      int total = 0, n_words = 0;
      for (const std::string &word : words)
      {
        constexpr int of_name = 16, of_section = 4;
        const int one = of_name * rank(word, key.name) + of_section * rank(word, key.section) +
                        rank(word, key.help);
        n_words += one > 0 ? 1 : 0;
        total += one;
      }
      if (n_words > most_words)
        found.clear();
      most_words = std::max(most_words, n_words);
      if (n_words == most_words && n_words > 0)
        found.emplace_back(total, &key);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto &a, const auto &b) { return a.first > b.first; });
    constexpr std::size_t most_described = 5, most_named = 15;
    const bool has_all = static_cast<std::size_t>(most_words) == words.size();
    std::string described = found.empty() || has_all
                                ? ""
                                : "no key matches all of these words; the following match " +
                                      std::to_string(most_words) + " of " +
                                      std::to_string(words.size()) + "\n",
                named;
    for (std::size_t i = 0; i < std::min(found.size(), most_named); ++i)
      if (i < most_described)
        described += found[i].second->description();
      else
        named += (named.empty() ? "also: " : ", ") + found[i].second->path();
    if (found.size() > most_named)
      named += " and " + std::to_string(found.size() - most_named) + " more; give another word too";
    return described + (named.empty() ? "" : named + "\n");
  }

  std::string Keys::describe(const std::string &path) const
  {
    std::string result;
    for (const Key &key : keys_)
      if (!key.section.empty() && base::to_lower(key.section) == base::to_lower(path))
        result += key.description();
    if (result.empty() && matches(path).size() == 1)
      result = find(path).description();
    if (result.empty() && path.find('/') == std::string::npos)
      result = search(path);
    if (result.empty())
      refuse(path);
    return result;
  }

  std::string Keys::text(bool has_help)
  {
    enter("");
    std::ostringstream text;
    parameters_->print_parameters(text, has_help ? dealii::ParameterHandler::PRM
                                                 : dealii::ParameterHandler::ShortText);
    return text.str();
  }
} // namespace plumbline::scene
