#include "geometry/msh_file.h"

#include "base/number_text.h"
#include "geometry/msh_elements.h"
#include "geometry/msh_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <tuple>
#include <unordered_map>

namespace plumbline::geometry
{
  namespace
  {
    /// Out of the plane z = 0 by more than this fraction of the largest coordinate.
    constexpr double off_plane = 1e-10;

    constexpr long most = std::numeric_limits<int>::max();
    constexpr long any_tag = std::numeric_limits<long>::max();

    using msh::find_high, msh::hexahedron, msh::is_one_of, msh::quadrilateral, msh::tetrahedron,
        msh::triangle;
    using Section = MshSection;

    std::string begin_of(Section section)
    {
      return "$" + base::word(section);
    }

    bool begins_with(std::string word, const std::string &begin)
    {
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return word.compare(0, begin.size(), begin) == 0;
    }

    /// The sections of a file, one after the other.
    class Reader
    {
    public:
      /// @param dimension  of the cells that count
      Reader(const std::string &text, const std::string &source, unsigned int dimension,
             SideCurves *curves)
          : words_(text, source), source_(source), dimension_(dimension), curves_(curves)
      {
      }

      void read()
      {
        if (words_.word() != begin_of(Section::format))
          words_.fail("does not begin with $MeshFormat, as .msh files do; mesh a .geo file, or "
                      "export the mesh from gmsh");
        format();
        end_section(base::word(Section::format), 1);
        bool has_elements = false;
        for (std::string word(words_.word()); !word.empty(); word = words_.word())
        {
          const std::size_t begin = words_.line();
          if (word[0] != '$')
            words_.fail("text stands outside of the sections ($Nodes, $Elements, ...); mend the "
                        "file, or export it again");
          const std::string name = word.substr(1);
          const auto section = base::from_word<Section>(name);
          if (section == Section::nodes && has_elements)
            words_.fail("$Nodes stands behind $Elements, which needs it; export the file again");
          has_elements = has_elements || section == Section::elements;
          if (section == Section::groups)
            physical_names();
          else if (section == Section::entities && is_4_)
            entities();
          else if (section == Section::nodes)
            is_4_ ? nodes_4() : nodes_2();
          else if (section == Section::elements)
            is_4_ ? elements_4() : elements_2();
          else
          {
            skip_section(name, begin);
            continue;
          }
          end_section(name, begin);
        }
        if (vertices_.empty() || !has_elements)
          words_.fail(std::string("the file ends without ") +
                      (vertices_.empty() ? "$Nodes" : "$Elements") + "; export it again");
      }

      /// In the plane.
      Mesh mesh(bool has_collar)
      {
        if (const double height = largest_height(); height > off_plane * largest_)
          throw InputError(source_ + " reaches z = " + base::to_text(height, 6) +
                           "; only triangles and quadrilaterals in the plane z = 0 are allowed");
        const std::map<long, bool> is_omega = check_groups(has_collar);
        sort_cells();
        Mesh mesh;
        mesh.vertices = std::move(vertices_);
        long last = 0; // physical groups are numbered from 1
        for (const msh::Cell &cell : cells_)
        {
          if (cell.group != last)
            mesh.groups.push_back(names_.at(last = cell.group));
          const auto &v = cell.vertex;
          mesh.cells.push_back({{v[0], v[1], v[2], v[3]},
                                cell.type == triangle ? 3U : 4U,
                                is_omega.at(cell.group),
                                static_cast<unsigned int>(mesh.groups.size() - 1)});
        }
        return mesh;
      }

      TetrahedralMesh tetrahedra()
      {
        const std::map<long, bool> is_omega = check_groups(true);
        sort_cells();
        TetrahedralMesh mesh;
        for (std::size_t k = 0; k < vertices_.size(); ++k)
          mesh.vertices.emplace_back(vertices_[k][0], vertices_[k][1], heights_[k]);
        long last = 0; // physical groups are numbered from 1
        for (const msh::Cell &cell : cells_)
        {
          if (cell.group != last)
            mesh.groups.push_back(names_.at(last = cell.group));
          mesh.group.push_back(static_cast<unsigned int>(mesh.groups.size() - 1));
          const auto &v = cell.vertex;
          mesh.is_inside.push_back(is_omega.at(cell.group) ? 1 : 0);
          if (cell.type == tetrahedron)
            mesh.cells.push_back({v[0], v[1], v[2], v[3]});
          else // gmsh counts around the lower and the upper face
            mesh.hexahedra.push_back({v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
        }
        if (!mesh.cells.empty() && !mesh.hexahedra.empty())
          throw InputError(source_ + " has " + std::to_string(mesh.cells.size()) +
                           " tetrahedra and " + std::to_string(mesh.hexahedra.size()) +
                           " hexahedra; give cells of one kind (gmsh: Recombine all surfaces and "
                           "volumes, or none)");
        return mesh;
      }

    private:
      void format()
      {
        const double version = words_.number("the version of the format");
        is_4_ = version == 4.1;
        if (!is_4_ && !(version >= 2 && version < 3))
          words_.fail("the format's version is none of 2.2 and 4.1; export the mesh with "
                      "Mesh.MshFileVersion = 4.1");
        words_.integer("the kind of file", 0, 0);
        words_.integer("the bytes of a number", 1, most);
      }

      static std::string end_of(const std::string &name) { return "$End" + name; }

      void end_section(const std::string &name, std::size_t begin)
      {
        const std::string_view word = words_.word();
        if (word == end_of(name))
          return;
        words_.fail(word.empty() ? "the file ends within $" + name + ", begun in line " +
                                       std::to_string(begin) + "; it was cut off, export it again"
                                 : "$" + name + ", begun in line " + std::to_string(begin) +
                                       ", holds more than it announces; correct its count");
      }

      void skip_section(const std::string &name, std::size_t begin)
      {
        std::string_view word;
        do
        {
          words_.skip_line();
          word = words_.word();
        } while (!word.empty() && word != end_of(name));
        if (word.empty())
          end_section(name, begin);
      }

      long count(const std::string &what) { return words_.integer(what, 0, most); }

      void physical_names()
      {
        const long n = count("the number of names");
        for (long i = 0; i < n; ++i)
        {
          const long dimension = words_.integer("the dimension of a name", 0, 3);
          const long tag = words_.integer("the number of a physical group", 0, any_tag);
          const std::string name = words_.quoted("a physical group's name");
          if (dimension == dimension_)
            names_[tag] = name;
        }
      }

      void entities()
      {
        const std::array<long, 4> n = {count("the number of points"), count("the number of curves"),
                                       count("the number of surfaces"),
                                       count("the number of volumes")};
        for (long dimension = 0; dimension < 4; ++dimension)
          for (long i = 0; i < n[dimension]; ++i)
          {
            const long tag = words_.integer("the number of an entity", -any_tag, any_tag);
            for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
              words_.number("a coordinate of an entity");
            const long n_groups = count("the number of its physical groups");
            if (dimension == dimension_ && n_groups > 1)
              words_.fail(body() + " " + std::to_string(tag) + " is in " +
                          std::to_string(n_groups) + " physical " + body() +
                          "s; let it be in one of them");
            for (long k = 0; k < n_groups; ++k)
            {
              const long group = words_.integer("a physical group", -any_tag, any_tag);
              if (dimension == dimension_)
                group_of_body_[tag] = std::abs(group);
            }
            const long n_bounds = dimension == 0 ? 0 : count("the number of its boundaries");
            for (long k = 0; k < n_bounds; ++k)
              words_.integer("a boundary of an entity", -any_tag, any_tag);
          }
      }

      void add_vertex(long tag, std::size_t line)
      {
        const double x = words_.number("x"), y = words_.number("y"), z = words_.number("z");
        const auto index = static_cast<unsigned int>(vertices_.size());
        if (!number_.emplace(tag, index).second)
          words_.fail(line, "node " + std::to_string(tag) + " is given twice; number them anew");
        vertices_.emplace_back(x, y);
        heights_.push_back(z);
        largest_ = std::max({largest_, std::abs(x), std::abs(y)});
      }

      void nodes_2()
      {
        const long n = count("the number of nodes");
        for (long i = 0; i < n; ++i)
        {
          const long tag = words_.integer("a node's number", 0, any_tag);
          add_vertex(tag, words_.line());
        }
      }

      void nodes_4()
      {
        const long n_blocks = count("the number of blocks of nodes");
        for (int k = 0; k < 3; ++k) // all nodes, the least and the largest number
          words_.integer("a number of nodes", 0, any_tag);
        for (long b = 0; b < n_blocks; ++b)
        {
          const long dimension = words_.integer("a dimension", 0, 3);
          words_.integer("the number of an entity", -any_tag, any_tag);
          const bool is_parametric = words_.integer("whether nodes are parametric", 0, 1) == 1;
          const long n = count("the number of nodes of a block");
          std::vector<std::pair<long, std::size_t>> tags;
          for (long i = 0; i < n; ++i)
          {
            const long tag = words_.integer("a node's number", 0, any_tag);
            tags.emplace_back(tag, words_.line());
          }
          for (const auto &[tag, line] : tags)
          {
            add_vertex(tag, line);
            for (long k = 0; is_parametric && k < dimension; ++k)
              words_.number("a parameter of a node");
          }
        }
      }

      unsigned int node_of_cell()
      {
        const long tag = words_.integer("a node of a cell", 0, any_tag);
        const auto found = number_.find(tag);
        if (found == number_.end())
          words_.fail("node " + std::to_string(tag) +
                      " of a cell is none of $Nodes; export the "
                      "file again");
        return found->second;
      }

      void add_cell(msh::Cell cell)
      {
        const msh::HighTriangle *const high = find_high(cell.type);
        const bool has_four = cell.type == quadrilateral || cell.type == tetrahedron;
        for (long i = 0; i < (cell.type == hexahedron ? 8 : has_four ? 4 : 3); ++i)
          cell.vertex[i] = node_of_cell();
        for (unsigned int side = 0; high != nullptr && side < 3; ++side)
        {
          const unsigned int a = cell.vertex[side], b = cell.vertex[(side + 1) % 3];
          std::vector<Point<2>> points;
          for (unsigned int k = 0; k < high->n_on_side; ++k)
            points.push_back(vertices_[node_of_cell()]);
          if (a > b)
            std::reverse(points.begin(), points.end());
          curves_->emplace(std::minmax(a, b), std::move(points));
        }
        for (unsigned int k = 0; high != nullptr && k < high->n_inside; ++k)
          node_of_cell();
        if (high != nullptr)
          cell.type = triangle;
        cells_.push_back(cell);
      }

      /// Whether the cells of an entity matter: not those of points, curves, volumes (in space
      /// surfaces), and of surfaces (volumes) that are not physical.
      bool is_taken(long type, long group) const
      {
        if (dimension_ == 3)
          return is_taken_in_space(type, group);
        const bool is_high = curves_ != nullptr && find_high(type) != nullptr;
        const bool is_surface = type == triangle || type == quadrilateral || is_high;
        if (group != 0 && is_one_of(msh::other_surfaces, type) && !is_high)
          words_.fail("has cells of gmsh's type " + std::to_string(type) + "; only " +
                      (curves_ == nullptr
                           ? "triangles and quadrilaterals of first order are allowed "
                             "(Mesh.ElementOrder = 1), or triangles of second to fourth order with "
                             "Domain/sides = curved"
                           : "triangles of first to fourth order are allowed where sides are "
                             "curved (Mesh.ElementOrder = 4, no Recombine)"));
        return is_surface && group != 0;
      }

      bool is_taken_in_space(long type, long group) const
      {
        if (group != 0 && msh::is_other_volume(type))
          words_.fail("has cells of gmsh's type " + std::to_string(type) + msh::volume_name(type) +
                      "; only tetrahedra or hexahedra of first order are allowed: recombine all "
                      "surfaces and volumes, or none, and set Mesh.ElementOrder = 1");
        return (type == tetrahedron || type == hexahedron) && group != 0;
      }

      void elements_2()
      {
        const long n = count("the number of elements");
        for (long i = 0; i < n; ++i)
        {
          words_.integer("an element's number", 0, any_tag);
          const long type = words_.integer("an element's type", 1, most);
          const long n_tags = words_.integer("the number of an element's tags", 0, 1000);
          std::array<long, 2> tags{}; // its physical group and its entity, then others
          for (long k = 0; k < n_tags; ++k)
            (k < 2 ? tags[k] : tags[1]) =
                words_.integer("a tag of an element", -any_tag, k < 2 ? any_tag : most);
          if (is_taken(type, tags[0]))
            add_cell({std::abs(tags[0]), tags[1], type, {}});
          else
            words_.skip_line();
        }
      }

      void elements_4()
      {
        const long n_blocks = count("the number of blocks of elements");
        for (int k = 0; k < 3; ++k)
          words_.integer("a number of elements", 0, any_tag);
        for (long b = 0; b < n_blocks; ++b)
        {
          const long dimension = words_.integer("a dimension", 0, 3);
          const long entity = words_.integer("the number of an entity", -any_tag, any_tag);
          const long type = words_.integer("the type of elements", 1, most);
          const long n = count("the number of elements of a block");
          const auto found = group_of_body_.find(entity);
          const bool is_physical = dimension == dimension_ && found != group_of_body_.end();
          const bool is_lower =
              is_one_of(msh::points_and_lines, type) || (dimension == 3 && msh::is_surface(type));
          if (dimension == dimension_ && is_lower)
            words_.fail("elements of type " + std::to_string(type) + " are not cells of a " +
                        body());
          const bool is_wanted = is_physical && is_taken(type, found->second);
          for (long i = 0; i < n; ++i)
          {
            words_.integer("an element's number", 0, any_tag);
            if (is_wanted)
              add_cell({found->second, entity, type, {}});
            else
              words_.skip_line();
          }
        }
      }

      /// What cells belong to.
      std::string body() const { return dimension_ == 2 ? "surface" : "volume"; }

      /// By physical surface or volume, in the order of their numbers.
      std::map<long, bool> check_groups(bool wants_collar) const
      {
        std::map<long, bool> is_omega;
        for (const msh::Cell &cell : cells_)
          is_omega[cell.group] = false;
        std::string all;
        bool has_omega = false, has_collar = false, has_other = false;
        for (auto &[group, is_inside] : is_omega)
        {
          const auto found = names_.find(group);
          const std::string name = found == names_.end() ? "" : found->second;
          const bool is_collar = begins_with(name, "collar");
          is_inside = begins_with(name, "omega");
          has_omega = has_omega || is_inside;
          has_collar = has_collar || is_collar;
          has_other = has_other || !(is_inside || (is_collar && wants_collar));
          all += (all.empty() ? "" : ", ") +
                 (name.empty() ? "number " + std::to_string(group) : "'" + name + "'");
        }
        if (!has_omega || has_collar != wants_collar || has_other)
          throw InputError(
              source_ + " has the physical " + body() + "s " + (all.empty() ? "(none)" : all) +
              (wants_collar ? "; give names that begin with 'omega' and 'collar', at least one "
                              "of each and no others"
                            : "; a body with a free boundary has no collar: give names that "
                              "begin with 'omega', at least one and no others"));
        return is_omega;
      }

      double largest_height() const
      {
        double largest = 0;
        for (const double z : heights_)
          largest = std::max(largest, std::abs(z));
        return largest;
      }

      void sort_cells()
      {
        std::stable_sort(
            cells_.begin(), cells_.end(),
            [](const msh::Cell &a, const msh::Cell &b)
            { return std::tie(a.group, a.entity, a.type) < std::tie(b.group, b.entity, b.type); });
      }

      MshWords words_;
      std::string source_;
      bool is_4_ = false;
      long dimension_;
      std::map<long, std::string> names_;  ///< of physical surfaces or volumes
      std::map<long, long> group_of_body_; ///< of version 4: of a surface or volume
      std::vector<Point<2>> vertices_;
      std::unordered_map<long, unsigned int> number_;
      std::vector<double> heights_; ///< z of the vertices
      double largest_ = 0;          ///< of their x and y
      SideCurves *curves_;
      std::vector<msh::Cell> cells_;
    };
  } // namespace

  bool is_other_msh(const std::string &text)
  {
    const auto begins = [&](const std::string &with)
    { return text.compare(0, with.size(), with) == 0; };
    if (begins("$NOD"))
      return true;
    std::istringstream head(text.substr(0, 100));
    std::string section, version, kind;
    head >> section >> version >> kind;
    static const std::set<std::string> others = {"1", "1.0", "3", "3.0", "4", "4.0"};
    const std::string binary = "1";
    return section == begin_of(Section::format) && (kind == binary || others.count(version) > 0);
  }

  Mesh read_msh(const std::string &text, const std::string &source, bool has_collar,
                SideCurves *curves)
  {
    Reader reader(text, source, 2, curves);
    reader.read();
    return reader.mesh(has_collar);
  }

  TetrahedralMesh read_msh_tetrahedra(const std::string &text, const std::string &source)
  {
    Reader reader(text, source, 3, nullptr);
    reader.read();
    return reader.tetrahedra();
  }
} // namespace plumbline::geometry
