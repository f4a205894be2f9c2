#include "meshfree/lattice_method.h"

#include "base/error.h"
#include "meshfree/lattice_operator.h"
#include "meshfree/rules.h"
#include "study/lattice_solve.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Vector;
    using geometry::NodeSet;

    /// b at the nodes.
    Vector nodal_load(const scene::Problem &problem, const NodeSet &nodes)
    {
      Vector load(nodes.size());
      const geometry::Lattice &lattice = problem.lattice;
      std::size_t block = 0;
      for (unsigned int c = 0; c < nodes.n_components; ++c, block += nodes.n_positions())
      {
        std::vector<double> smooth;
        if (problem.load.series)
        {
          const auto at_nodes = [&](unsigned int axis)
          {
            std::vector<double> rows;
            for (int i = 0; i < nodes.n[axis]; ++i)
            {
              const auto basis = problem.load.series->basis(
                  axis, lattice.origin()[axis] + lattice.h() * (i + nodes.axis[0].offset));
              rows.insert(rows.end(), basis.begin(), basis.end());
            }
            return rows;
          };
          smooth = problem.load.series->contract(c, at_nodes(0), at_nodes(1));
        }
        std::size_t position = 0;
        for (int j = 0; j < nodes.n[1]; ++j)
          for (int i = 0; i < nodes.n[0]; ++i, ++position)
            if (nodes.is_free[position] != 0)
            {
              const auto place = nodes.place(0, i, j);
              load[block + position] =
                  smooth.empty() ? problem.load.value(lattice.point(place[0], place[1]), c)
                                 : smooth[position];
            }
      }
      return load;
    }

    /// Values on nodes as the piecewise constant function K_κ u on the squares around them.
    struct NodalField
    {
      geometry::Lattice lattice;
      NodeSet nodes;
      Vector values;

      double value(const Point<2> &x, unsigned int component) const
      {
        std::array<int, 2> i{};
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double s = (x[d] - lattice.origin()[d]) / lattice.h() - nodes.axis[0].offset;
          i[d] = std::clamp(static_cast<int>(std::floor(s + .5)), 0, nodes.n[d] - 1);
        }
        return values[component * nodes.n_positions() +
                      static_cast<std::size_t>(i[1]) * nodes.n[0] + i[0]];
      }
      void write_vtu(const std::string &file) const;
    };

    /// A point cloud: one vertex a node, u as point data. VTU in ASCII.
    void NodalField::write_vtu(const std::string &file) const
    {
      std::ofstream out(file);
      if (!out)
        throw InputError("cannot write '" + file + "'; give a writable output folder (-o)");
      const std::size_t n = nodes.n_unknowns() / nodes.n_components;
      out.precision(17);
      out << "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n<Piece "
             "NumberOfPoints=\""
          << n << "\" NumberOfCells=\"" << n
          << "\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">\n";
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
          if (nodes.free(0, i, j))
          {
            const auto place = nodes.place(0, i, j);
            out << lattice.point(place[0], place[1]) << " 0\n";
          }
      out << "</DataArray></Points>\n<PointData><DataArray type=\"Float64\" Name=\"u\" "
             "NumberOfComponents=\""
          << nodes.n_components << "\">\n";
      for (std::size_t i = 0; i < nodes.n_positions(); ++i)
        if (nodes.is_free[i] != 0)
          for (unsigned int c = 0; c < nodes.n_components; ++c)
            out << values[c * nodes.n_positions() + i] << (c + 1 < nodes.n_components ? ' ' : '\n');
      const auto list = [&](const std::string &name, const std::string &type, const auto &entry)
      {
        out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\">\n";
        for (std::size_t i = 0; i < n; ++i)
          out << entry(i) << '\n';
        out << "</DataArray>\n";
      };
      out << "</DataArray></PointData>\n<Cells>\n";
      list("connectivity", "Int64", [](std::size_t i) { return i; });
      list("offsets", "Int64", [](std::size_t i) { return i + 1; });
      list("types", "UInt8", [](std::size_t) { return 1; });
      out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    }

    void describe_weights(const Bonds &bonds, study::Diagnostics &diagnostics)
    {
      diagnostics.n_neighbours = static_cast<unsigned int>(bonds.family.size());
      diagnostics.notes = bonds.notes;
      for (const Bond &bond : bonds.family)
      {
        diagnostics.smallest_weight_ratio =
            std::min(diagnostics.smallest_weight_ratio, bond.weight / bond.area);
        diagnostics.n_negative_weights += bond.weight < 0 ? 1 : 0;
      }
    }

    class LatticeMethod : public study::Method
    {
    public:
      explicit LatticeMethod(Rule rule) : rule_(std::move(rule)) {}
      std::string name() const override { return rule_.name; }
      std::string family() const override { return "meshfree"; }
      std::string help() const override { return rule_.help; }
      std::string why_not(const scene::Scene &) const override { return {}; }

      study::Solution solve(const scene::Scene &scene, const scene::Problem &problem) const override
      {
        const base::MemoryGauge memory;
        const base::CpuTimer timer;
        const geometry::Lattice &lattice = problem.lattice;
        const NodeSet nodes = study::comparison_nodes(scene, lattice, problem.n_components);
        const Bonds bonds = rule_.bonds(problem.kernel, lattice.h(), scene.backend);
        const auto stencil = lattice_operator(problem.kernel, bonds);
        const double rule_seconds = timer.seconds();
        study::LatticeSolve solved = study::solve_on_lattice(
            scene, problem, nodes, stencil, [&] { return nodal_load(problem, nodes); });

        study::Solution solution;
        solution.cost = solved.cost;
        solution.cost.setup_seconds += rule_seconds;
        solution.cost.peak_bytes = memory.peak_bytes();
        solution.diagnostics = solved.diagnostics;
        describe_weights(bonds, solution.diagnostics);
        for (int j = 0; j < nodes.n[1]; ++j)
          for (int i = 0; i < nodes.n[0]; ++i)
            if (nodes.free(0, i, j))
            {
              const auto place = nodes.place(0, i, j);
              solution.nodes.push_back(lattice.point(place[0], place[1]));
              for (unsigned int c = 0; c < nodes.n_components; ++c)
                solution.nodal.push_back(
                    solved.solution[c * nodes.n_positions() +
                                    static_cast<std::size_t>(j) * nodes.n[0] + i]);
            }
        solution.averages = solution.nodal;
        const auto field = std::make_shared<const NodalField>(
            NodalField{lattice, nodes, std::move(solved.solution)});
        solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
        solution.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
        return solution;
      }

    private:
      Rule rule_;
    };
  } // namespace

  study::Methods lattice_methods()
  {
    study::Methods methods;
    for (const Rule &rule : rules())
      methods.push_back(std::make_shared<LatticeMethod>(rule));
    return methods;
  }
} // namespace plumbline::meshfree
