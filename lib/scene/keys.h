#pragma once

#include "base/choice.h"
#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"

#include <deal.II/base/point.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace dealii
{
  class ParameterHandler;
  namespace Patterns
  {
    class PatternBase;
  }
} // namespace dealii

namespace plumbline::scene
{
  // Allowed values of keys: deal.II patterns with readable descriptions.
  using Allowed = std::shared_ptr<const dealii::Patterns::PatternBase>;

  Allowed any_text();
  Allowed yes_or_no();
  Allowed one_of(const std::vector<std::string> &words);
  Allowed some_of(const std::vector<std::string> &words); ///< one or more, separated by ','
  Allowed count(int lowest, int highest = std::numeric_limits<int>::max());
  Allowed any_number();
  Allowed positive();
  Allowed between(double lowest, double highest);
  Allowed numbers();          ///< separated by ','
  Allowed positive_numbers(); ///< the same, above 0
  Allowed boxes();            ///< "x0, y0 : x1, y1; ..."
  Allowed any_boxes();        ///< the same, or in space "x0, y0, z0 : x1, y1, z1; ..."
  Allowed lines();            ///< the same, of two points or more

  /// @param allowed  boxes() or lines()
  /// @throws InputError  anything else
  std::vector<std::vector<dealii::Point<2>>> to_lines(const std::string &text,
                                                      const Allowed &allowed);

  /// @throws InputError  text that boxes() does not allow; a box without area
  std::vector<geometry::Box> to_boxes(const std::string &text);

  /// Boxes 'x0, y0, z0 : x1, y1, z1' in space; none where the first corner has other than three
  /// coordinates.
  /// @throws InputError  another corner has not three numbers; a box without volume
  std::vector<geometry::Cuboid> to_cuboids(const std::string &text);

  /// The keys of a scene file, each bound to the member that takes its value.
  class Keys
  {
  public:
    Keys();
    ~Keys();

    /// Keys added from now on belong to this section; "": to none.
    void enter(const std::string &section);

    /// A key bound to a member; its default is the member's current value.
    /// @tparam T  bool, int, unsigned int, double, std::string, std::vector<double>
    template <class T>
    void add(const std::string &name, T &member, const Allowed &allowed, const std::string &help);
    void add(const std::string &name, std::string &member, const std::string &help);

    /// The same for an enum with words.
    template <class Enum>
    std::enable_if_t<std::is_enum_v<Enum>> add(const std::string &name, Enum &member,
                                               const std::string &help);

    /// The same for a bool, with one word for false and one for true.
    void add(const std::string &name, bool &member, const std::string &if_false,
             const std::string &if_true, const std::string &help);

    /// A key that is read by a function; so is its default.
    using Read = std::function<void(const std::string &text)>;
    void add(const std::string &name, const std::string &by_default, const Allowed &allowed,
             const Read &read, const std::string &help);

    /// Give "Section/key", or a key outside sections, a value; both may have former names, see
    /// scene/aliases.h. Their case does not matter, nor does the section where one alone has such a
    /// key. Numbers may be fractions: 1/12.
    /// @throws InputError  unknown key, or a value that is not allowed
    void set(const std::string &path, const std::string &given_value);

    /// Whether it was set; whether it was set to a value other than its default.
    /// @pre  the key exists
    bool is_given(const std::string &path) const { return find(path).is_given; }
    bool is_changed(const std::string &path) const { return is_changed(find(path)); }
    std::vector<std::string> changed_keys(const std::string &section) const;
    std::string value(const std::string &path) const; ///< as it was set, or the default
    const std::string &default_of(const std::string &path) const { return find(path).by_default; }

    /// Its "Section/key", of a path that set() takes; an unknown path as it is.
    std::string name_of(const std::string &path) const;

    /// Meaning, default and allowed values of a key; for "Section", of all its keys; for other
    /// words, of the keys whose names and meanings have them, names first.
    /// @throws InputError  no such key, nor any with these words; the message names similar ones
    std::string describe(const std::string &path) const;

    /// All keys with their values, and optionally with their meanings.
    std::string text(bool has_help);

  private:
    struct Key
    {
      std::string section, name, by_default;
      Allowed allowed;
      std::string help;
      std::string value = {}; ///< as set
      bool is_given = false;

      std::string path() const { return section.empty() ? name : section + "/" + name; }
      std::string description() const;
    };
    void remember(const std::string &name, const Allowed &allowed, const std::string &help);
    const Key &find(const std::string &path) const;
    std::vector<const Key *> matches(const std::string &path) const;
    [[noreturn]] void refuse(const std::string &path) const;
    std::string search(const std::string &words) const;
    static bool is_changed(const Key &key);

    std::string section_; ///< current section of parameters_
    std::vector<Key> keys_;
    std::unique_ptr<dealii::ParameterHandler> parameters_;
  };

  template <class Enum>
  std::enable_if_t<std::is_enum_v<Enum>> Keys::add(const std::string &name, Enum &member,
                                                   const std::string &help)
  {
    const auto &all = base::words<Enum>;
    add(
        name, base::word(member), one_of({all.begin(), all.end()}),
        [&member](const std::string &text) { member = *base::from_word<Enum>(text); }, help);
  }
} // namespace plumbline::scene
