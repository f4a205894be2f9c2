#include "problem/capabilities.h"

#include <algorithm>

namespace plumbline::problem
{
  namespace
  {
    using C = Capability;
  }

  Capabilities operator|(Capabilities a, const Capabilities &b)
  {
    a.insert(b.begin(), b.end());
    return a;
  }

  Capabilities of_meshes()
  {
    return {C::meshes, C::quadrilaterals, C::triangles, C::mixed_cells};
  }

  Capabilities of_damage()
  {
    return {C::cracks, C::free_surfaces, C::damaged_dilatation};
  }

  Capabilities all_capabilities()
  {
    return all_but({});
  }

  Capabilities all_but(const Capabilities &left_out)
  {
    Capabilities rest;
    for (std::size_t i = 0; i < base::words<Capability>.size(); ++i)
      if (left_out.count(static_cast<Capability>(i)) == 0)
        rest.insert(static_cast<Capability>(i));
    return rest;
  }

  std::string capability_table(const std::string &of, const std::vector<Capable> &all)
  {
    std::vector<Capable> rows;
    for (const Capable &one : all)
    {
      const auto row = std::find_if(rows.begin(), rows.end(),
                                    [&](const Capable &other) { return other.can == one.can; });
      if (row == rows.end())
        rows.push_back(one);
      else
        row->name += ", " + one.name;
    }
    std::string head = "| " + of + " |", rule = "|---|", text;
    for (const Capability capability : all_capabilities())
    {
      head += " " + base::word(capability) + " |";
      rule += "---|";
    }
    for (const Capable &row : rows)
    {
      text += "| " + row.name + " |";
      for (const Capability capability : all_capabilities())
        text += row.can.count(capability) > 0 ? " yes |" : " - |";
      text += "\n";
    }
    return head + "\n" + rule + "\n" + text;
  }
} // namespace plumbline::problem
