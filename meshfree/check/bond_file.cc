#include "meshfree/check/bond_file.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"
#include "geometry/cell_locator.h"
#include "meshfree/check/given_rows.h"
#include "meshfree/check/row_families.h"
#include "meshfree/rules/families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>
#include <unordered_map>

namespace plumbline::meshfree
{
  namespace
  {
    template <int dim>
    std::string to_text(const Point<dim> &x)
    {
      std::ostringstream text;
      text << '(' << x[0];
      for (unsigned int d = 1; d < dim; ++d)
        text << ", " << x[d];
      text << ')';
      return text.str();
    }

    const std::array<std::string, 3> axes = {"x", "y", "z"};

    /// Numbers of the columns x, y and, in space, z.
    template <int dim>
    Point<dim> place(base::Csv &csv, const std::string &prefix = "")
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = csv.number(prefix + axes[d]);
      return x;
    }

    template <int dim>
    std::vector<std::string> columns_of_nodes()
    {
      std::vector<std::string> result = {"id", "x", "y", "volume"};
      if (dim == 3)
        result.insert(result.begin() + 3, "z");
      return result;
    }

    /// Rounding of a double, as of coordinates far from the origin.
    double last_digit(double number)
    {
      return std::numeric_limits<double>::epsilon() * std::abs(number);
    }

    /// Of all values of a column.
    double largest_rounding(const base::PrintedDigits &digits, double number)
    {
      return std::max(digits.rounding(number), last_digit(number));
    }

    /// @param z  of the first node, if the file has z
    void check_plane(base::Csv &csv, std::optional<double> &z)
    {
      if (!csv.has("z"))
        return;
      const double own = csv.number("z");
      if (z && own != *z)
        csv.fail("z = " + base::to_text(own, 6) + " where other nodes have " +
                 base::to_text(*z, 6) + "; give the nodes of one plane, check is for 2D");
      z = own;
    }
  } // namespace

  template <int dim>
  GivenNodes<dim> read_given_nodes(const std::string &file)
  {
    base::Csv csv(file, columns_of_nodes<dim>(), {"id"});
    const bool is_numbered = csv.has("id");
    if (!is_numbered && !csv.has("block_id"))
      csv.fail_without("id");
    GivenNodes<dim> nodes;
    std::optional<double> z;
    nodes.file = file;
    std::unordered_map<std::int64_t, std::size_t> line_of_id;
    std::map<std::array<double, dim>, std::size_t> line_of_place;
    while (csv.next())
    {
      const std::int64_t id =
          is_numbered ? csv.integer("id") : static_cast<std::int64_t>(nodes.size() + 1);
      if (dim == 2)
        check_plane(csv, z);
      const Point<dim> x = place<dim>(csv);
      std::array<double, dim> key{};
      for (unsigned int d = 0; d < dim; ++d)
        key[d] = x[d];
      const double volume = csv.number("volume");
      if (!(volume > 0))
        csv.fail("the volume " + std::to_string(volume) + " of node " + std::to_string(id) +
                 " is not positive; give the " + (dim == 2 ? "area" : "volume") + " of its cell");
      if (const auto [other, is_new] = line_of_id.emplace(id, csv.line()); !is_new)
        csv.fail("id " + std::to_string(id) + " is that of line " + std::to_string(other->second) +
                 " already; give every node an id of its own");
      if (const auto [other, is_new] = line_of_place.emplace(key, csv.line()); !is_new)
        csv.fail("node " + std::to_string(id) + " lies at " + to_text(x) + ", where that of line " +
                 std::to_string(other->second) + " is; take one of them out");
      nodes.id.push_back(id);
      nodes.places.push_back(x);
      nodes.volume.push_back(volume);
      nodes.line.push_back(csv.line());
    }
    for (unsigned int d = 0; d < dim; ++d)
      for (const Point<dim> &x : nodes.places)
        nodes.rounding = std::max(nodes.rounding, largest_rounding(csv.digits(axes[d]), x[d]));
    for (const double volume : nodes.volume)
      nodes.volume_rounding =
          std::max(nodes.volume_rounding, csv.digits("volume").rounding(volume) / volume);
    nodes.notes = csv.notes();
    if (!is_numbered)
      nodes.notes.emplace_back("there is no column id, as in Peridigm's text: ids are the numbers "
                               "of the rows, from 1; block_id is left out");
    if (z)
      nodes.notes.push_back("z = " + base::to_text(*z, 6) + " of all nodes is left out");
    return nodes;
  }

  std::vector<std::size_t> nodes_inside(const GivenNodes<2> &nodes, const geometry::Mesh &mesh)
  {
    const geometry::CellLocator cells(mesh);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const auto cell = cells.find(nodes.places[i]); cell && cells.is_inside(*cell))
        result.push_back(i);
    if (result.empty())
      throw InputError("'" + nodes.file + "': none of the " + std::to_string(nodes.size()) +
                       " nodes lies in the domain of the scene; check units and Domain/boxes");
    return result;
  }

  void check_places(const GivenNodes<2> &nodes, const geometry::Mesh &mesh,
                    const std::string &level)
  {
    const geometry::CellLocator cells(mesh);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!cells.find(nodes.places[i]))
        throw InputError("'" + nodes.file + "'" +
                         (nodes.line[i] > 0 ? ", line " + std::to_string(nodes.line[i]) : "") +
                         ": node " + std::to_string(nodes.id[i]) + " at " +
                         to_text(nodes.origin + nodes.places[i]) +
                         " lies outside the domain and interaction domain at level " + level +
                         "; if those are not the h and horizon of your bonds (Study), correct "
                         "them; otherwise remove nodes that no bond reaches, such as the corners "
                         "of a square interaction domain, or move them in");
    if (const auto twins = geometry::find_coincident_nodes(nodes.places, mesh))
      throw InputError("'" + nodes.file + "', line " + std::to_string(nodes.line[twins->second]) +
                       ": node " + std::to_string(nodes.id[twins->second]) + " " +
                       twins->place("node " + std::to_string(nodes.id[twins->first]) + " of line " +
                                    std::to_string(nodes.line[twins->first])) +
                       "; take one of them out");
  }

  namespace
  {
    /// Whether a place lies on the boundary of Ω, to rounding of files.
    std::vector<bool> on_boundary(const GivenNodes<2> &nodes, const geometry::Mesh &mesh)
    {
      const double tolerance = 1e-6 * mesh.longest_side();
      const geometry::CellLocator locator(mesh);
      std::vector<bool> result;
      std::vector<unsigned int> near;
      for (const Point<2> &x : nodes.places)
      {
        locator.find(box_around(x, tolerance), near);
        const auto is_free = [&](unsigned int cell) { return locator.is_inside(cell); };
        result.push_back(std::any_of(near.begin(), near.end(), is_free) &&
                         !std::all_of(near.begin(), near.end(), is_free));
      }
      return result;
    }
  } // namespace

  template <int dim>
  geometry::NodeCells<dim> reordered(const geometry::NodeCells<dim> &cells,
                                     const std::vector<std::size_t> &order, std::size_t n_free)
  {
    geometry::NodeCells<dim> result;
    result.n_free = n_free;
    result.first_piece = {0};
    for (const std::size_t c : order)
    {
      result.nodes.push_back(cells.nodes[c]);
      result.source.push_back(cells.source[c]);
      result.area.push_back(cells.area[c]);
      result.centroid.push_back(cells.centroid[c]);
      for (std::size_t p = cells.first_piece[c]; p < cells.first_piece[c + 1]; ++p)
        result.pieces.push_back(cells.pieces[p]);
      result.first_piece.push_back(result.pieces.size());
    }
    return result;
  }

  double node_spacing(const GivenNodes<2> &nodes, const geometry::Mesh &mesh)
  {
    const std::vector<bool> is_on_boundary = on_boundary(nodes, mesh);
    double n = 0, area = 0;
    if (nodes.box) // where nodes on the boundary are not given twice
      n = static_cast<double>(nodes.size() - nodes.n_images);
    else
      for (const std::size_t i : nodes_inside(nodes, mesh))
        n += is_on_boundary[i] ? .5 : 1;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      if (mesh.cells[cell].is_inside)
        area += geometry::area(geometry::view(mesh.polygon(cell)));
    return std::sqrt(area / n);
  }

  GivenCells<2> given_cells(const GivenNodes<2> &nodes, const geometry::Mesh &mesh,
                            bool boundary_is_data)
  {
    const std::vector<bool> is_on_boundary = on_boundary(nodes, mesh);
    geometry::Mesh everywhere = mesh;
    for (geometry::MeshCell &cell : everywhere.cells)
      cell.is_inside = true;
    const geometry::NodeCells<2> uncut = geometry::voronoi_cells(nodes.places, everywhere);
    GivenCells<2> result;
    if (nodes.box)
    {
      result.cells = uncut;
      result.cells.n_free = nodes.size() - nodes.n_images;
      result.uncut_areas = uncut.area;
      return result;
    }
    const auto is_outside = [](const geometry::MeshCell &cell) { return !cell.is_inside; };
    if (std::any_of(mesh.cells.begin(), mesh.cells.end(), is_outside) &&
        nodes_inside(nodes, mesh).size() == nodes.size())
      throw InputError("'" + nodes.file + "': none of the " + std::to_string(nodes.size()) +
                       " nodes lies in the interaction domain around the domain, where u is "
                       "prescribed; add nodes there, or give the boundary as free or periodic "
                       "(--boundary, in Python boundary=)");
    result.n_on_boundary =
        static_cast<std::size_t>(std::count(is_on_boundary.begin(), is_on_boundary.end(), true));
    if (boundary_is_data)
    {
      const geometry::CellLocator locator(mesh);
      std::vector<std::size_t> order(nodes.size());
      std::iota(order.begin(), order.end(), 0);
      const auto in_collar =
          std::stable_partition(order.begin(), order.end(),
                                [&](std::size_t i)
                                {
                                  const auto cell = locator.find(nodes.places[i]);
                                  return !is_on_boundary[i] && cell && locator.is_inside(*cell);
                                });
      if (in_collar == order.begin())
        throw InputError("'" + nodes.file +
                         "': every node of the domain lies on its boundary, where "
                         "Methods/nodes = vertices puts data; add nodes inside");
      result.cells = reordered(uncut, order, static_cast<std::size_t>(in_collar - order.begin()));
    }
    else
      result.cells = geometry::voronoi_cells(nodes.places, mesh);
    for (const std::size_t i : result.cells.source)
      result.uncut_areas.push_back(uncut.area[i]);
    return result;
  }

  namespace
  {
    /// Of the weights by their digits, relative to most of them.
    template <int dim>
    double weight_rounding(const std::vector<GivenRow<dim>> &rows,
                           const base::PrintedDigits &digits)
    {
      std::vector<double> sizes;
      for (const GivenRow<dim> &row : rows)
        if (row.weight != 0)
          sizes.push_back(std::abs(row.weight));
      if (sizes.empty())
        return 0;
      const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
      std::nth_element(sizes.begin(), middle, sizes.end());
      return digits.rounding(*middle) / *middle;
    }

    template <int dim>
    std::vector<GivenRow<dim>> read_rows(base::Csv &csv)
    {
      std::vector<GivenRow<dim>> rows;
      while (csv.next())
      {
        GivenRow<dim> row{csv.integer("i"), csv.integer("j"), csv.number("weight"), {}, csv.line()};
        if (csv.has("qx") && !(csv.is_empty("qx") && csv.is_empty("qy")))
          row.kernel_point = place<dim>(csv, "q");
        if (row.kernel_point && row.kernel_point->square() == 0)
          csv.fail(std::string("the kernel point ") + (dim == 2 ? "(qx, qy)" : "(qx, qy, qz)") +
                   " is 0, the position of node i itself, where kernels may be "
                   "infinite; give a point of the neighbour's cell, relative to node i");
        rows.push_back(row);
      }
      return rows;
    }
  } // namespace

  template <int dim>
  GivenFamilies<dim> read_given_families(const std::string &file, const GivenNodes<dim> &nodes,
                                         const geometry::NodeCells<dim> &cells)
  {
    base::Csv csv(file, {"i", "j", "weight"});
    if (csv.has("qx") != csv.has("qy"))
      csv.fail("one of the columns qx and qy is missing; give both or none");
    if (dim == 3 && csv.has("qx") != csv.has("qz"))
      csv.fail("one of the columns qx, qy and qz is missing; give all or none");
    const std::vector<GivenRow<dim>> given = read_rows<dim>(csv);
    GivenFamilies<dim> result = families_of_rows(given, nodes, cells, RowSource{file, "line"});
    result.weight_rounding = weight_rounding<dim>(given, csv.digits("weight"));
    result.notes = csv.notes();
    return result;
  }

  template GivenNodes<2> read_given_nodes(const std::string &);
  template GivenNodes<3> read_given_nodes(const std::string &);
  template geometry::NodeCells<2> reordered(const geometry::NodeCells<2> &,
                                            const std::vector<std::size_t> &, std::size_t);
  template geometry::NodeCells<3> reordered(const geometry::NodeCells<3> &,
                                            const std::vector<std::size_t> &, std::size_t);
  template GivenFamilies<2> read_given_families(const std::string &, const GivenNodes<2> &,
                                                const geometry::NodeCells<2> &);
  template GivenFamilies<3> read_given_families(const std::string &, const GivenNodes<3> &,
                                                const geometry::NodeCells<3> &);
} // namespace plumbline::meshfree
