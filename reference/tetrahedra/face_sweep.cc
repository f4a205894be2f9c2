#include "reference/tetrahedra/face_sweep.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace plumbline::reference
{
  using dealii::Point;

  SortedFaces::SortedFaces(const TetrahedralMesh &mesh, const std::vector<Vertices> &faces,
                           double reach)
  {
    double volume = 0;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      volume += determinant(mesh, cell) / 6 / std::pow(reach, 3);
    of_vertex_ = volume / static_cast<double>(mesh.vertices.size());
    of_cell_ = volume / static_cast<double>(mesh.cells.size());
    std::vector<PairFace::Vertices> places(faces.size());
    for (std::size_t face = 0; face < faces.size(); ++face)
      for (unsigned int k = 0; k < 3; ++k)
        places[face][k] = Point<3>((mesh.vertices[faces[face][k]] - mesh.vertices.front()) / reach);
    sort(places);
    std::map<std::array<unsigned int, 2>, unsigned int> edges;
    for (const std::size_t face : order_)
    {
      NumberedFace numbered;
      numbered.number = static_cast<unsigned int>(numbered_.size());
      for (unsigned int k = 0; k < 3; ++k)
      {
        std::array<unsigned int, 2> ends = {faces[face][k], faces[face][(k + 1) % 3]};
        std::sort(ends.begin(), ends.end());
        numbered.edges[k] =
            edges.try_emplace(ends, static_cast<unsigned int>(edges.size())).first->second;
      }
      numbered_.push_back(numbered);
      scaled_.emplace_back(places[face], faces[face]);
    }
    for (NumberedFace &face : numbered_)
      face.face = &scaled_[face.number];
  }

  void SortedFaces::sort(const std::vector<PairFace::Vertices> &places)
  {
    // values that pairs share fit into some 30 MB
    const double spacing = std::cbrt(of_vertex_), size = spacing * (spacing > .25   ? 3
                                                                    : spacing > .15 ? 2
                                                                                    : 1);
    using Key = std::array<long, 3>;
    std::vector<std::pair<Key, std::size_t>> keys;
    for (const PairFace::Vertices &x : places)
    {
      Key key{};
      for (unsigned int d = 0; d < 3; ++d)
        key[d] = std::lround(std::floor((x[0][2 - d] + x[1][2 - d] + x[2][2 - d]) / 3 / size));
      keys.emplace_back(key, keys.size());
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t k = 0; k < keys.size(); ++k)
    {
      if (k == 0 || keys[k].first != keys[k - 1].first)
        blocks_.push_back(k);
      order_.push_back(keys[k].second);
    }
    blocks_.push_back(keys.size());
  }

  std::vector<geometry::Cuboid> SortedFaces::boxes() const
  {
    std::vector<geometry::Cuboid> boxes;
    for (const PairFace &face : scaled_)
      boxes.push_back(face.box());
    return boxes;
  }

  FaceSweep::FaceSweep(const SortedFaces &faces, const SolidKernel &kernel,
                       FacePotential::Kind kind, const FaceRule &rule, double size_of_pair,
                       std::vector<double> largest_jump, std::vector<char> is_needed)
      : faces_(faces), largest_jump_(std::move(largest_jump)), is_needed_(std::move(is_needed)),
        search_(faces.boxes())
  {
    for (const PotentialKernel &part : kernel.parts)
      integrals_.push_back(std::make_unique<const FaceIntegrals>(part, kind, faces_, largest_jump_,
                                                                 rule, rule.spacing / kernel.reach,
                                                                 kernel.m0 * size_of_pair));
  }

  std::array<double, 2> FaceSweep::diffusion() const
  {
    std::array<double, 2> result{};
    for (std::size_t part = 0; part < n_parts(); ++part)
      result[part] = integrals_[part]->diffusion();
    return result;
  }

  std::array<double, 2> FaceSweep::Workspace::values(std::size_t k) const
  {
    std::array<double, 2> result{};
    for (std::size_t part = 0; part < 2; ++part)
      if (k < of_parts[part].values.size())
        result[part] = of_parts[part].values[k];
    return result;
  }

  void FaceSweep::Workspace::add_use(FaceRuleUse &total) const
  {
    for (const FaceIntegrals::Workspace &part : of_parts)
    {
      for (unsigned int level = 0; level < total.n_pairs.size(); ++level)
        total.n_pairs[level] += part.use.n_pairs[level];
      total.error = std::max(total.error, part.use.error);
    }
  }

  void FaceSweep::for_each_face(std::size_t block, Workspace &work, const Action &action) const
  {
    const std::size_t first = faces_.blocks()[block], last = faces_.blocks()[block + 1];
    std::vector<std::vector<unsigned int>> near(last - first);
    std::vector<const NumberedFace *> own, all;
    find_candidates(first, last, work);
    std::vector<char> is_met(work.near.size());
    for (std::size_t face = first; face < last; ++face)
    {
      std::vector<unsigned int> &partners = near[face - first];
      for (std::size_t k = 0; k < work.near.size(); ++k)
        if (are_partners(face, work.near[k]))
        {
          partners.push_back(work.near[k]);
          if (is_met[k] == 0)
            all.push_back(&faces_.numbered(work.near[k]));
          is_met[k] = 1;
        }
      if (!partners.empty())
        own.push_back(&faces_.numbered(face));
    }
    for (std::size_t part = 0; part < n_parts(); ++part)
      integrals_[part]->start(own, all, work.of_parts[part]);
    for (std::size_t face = first; face < last; ++face)
    {
      for (std::size_t part = 0; part < n_parts(); ++part)
        integrals_[part]->find(face, near[face - first], work.of_parts[part]);
      action(face, near[face - first]);
    }
  }

  /// Faces that may be partners of one of a block.
  void FaceSweep::find_candidates(std::size_t first, std::size_t last, Workspace &work) const
  {
    geometry::Cuboid box = search_.box(static_cast<unsigned int>(first));
    for (std::size_t face = first; face < last; ++face)
    {
      const geometry::Cuboid &own = search_.box(static_cast<unsigned int>(face));
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] = std::min(box.lower[d], own.lower[d]);
        box.upper[d] = std::max(box.upper[d], own.upper[d]);
      }
    }
    for (unsigned int d = 0; d < 3; ++d)
    {
      box.lower[d] -= 1;
      box.upper[d] += 1;
    }
    search_.find(box, work.near);
    work.near.erase(work.near.begin(), std::lower_bound(work.near.begin(), work.near.end(), first));
  }

  /// Each pair once, so near that f may not vanish, and with a row that is asked for.
  bool FaceSweep::are_partners(std::size_t face, std::size_t other) const
  {
    if (other < face || (is_needed_[face] == 0 && is_needed_[other] == 0))
      return false;
    const PairFace &f = *faces_.numbered(face).face, &g = *faces_.numbered(other).face;
    const double reach = 1 + f.radius() + g.radius();
    return f.centre().distance_square(g.centre()) < reach * reach;
  }
} // namespace plumbline::reference
