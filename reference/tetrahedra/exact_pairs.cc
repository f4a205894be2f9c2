#include "reference/tetrahedra/exact_pairs.h"

#include "reference/tetrahedra/pair_form.h"
#include "reference/tetrahedra/two_part_number.h"

#include <cstdint>
#include <unordered_map>

namespace plumbline::reference
{
  namespace
  {
    namespace multiprecision = boost::multiprecision;
    using Quad = TwoPartNumber<long double>;
    using Octuple =
        multiprecision::number<multiprecision::cpp_bin_float<237, multiprecision::digit_base_2>,
                               multiprecision::et_off>;

    /// Heights of an edge over a plane that differ by less are equal; coordinates of some horizons
    /// are rounded by that much.
    constexpr double rounding = 2e-14;
    /// The same of edges that are parallel to all digits of Quad.
    constexpr double least_rounding = 1e-32;
    /// The same with 237 bits: coordinates are exact, and what is not parallel differs by more.
    constexpr double no_rounding = 1e-55;
    /// Faces nearer than this [horizons] take functions that are regular at 0.
    constexpr double compact_from = .1;

    template <class Real>
    FormFace<Real> form_face(const PairFace &face)
    {
      FormFace<Real> result;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto &x = face.vertices()[k];
        result.x[k] = {Real(x[0]), Real(x[1]), Real(x[2])};
      }
      result.names = face.names();
      return result;
    }

    template <class Real>
    FormFace<Real> form_face(const NumberedFace &face)
    {
      FormFace<Real> result = form_face<Real>(*face.face);
      result.edges = face.edges;
      result.number = face.number;
      return result;
    }

    /// Whether their projections on the line through their centres are at least a horizon (1)
    /// apart.
    bool are_out_of_reach(const PairFace &f, const PairFace &g)
    {
      const dealii::Tensor<1, 3> line = g.centre() - f.centre();
      const double distance = line.norm();
      if (distance < 1)
        return false;
      double last = -distance, first = 2 * distance; // along the line, from the centre of f
      for (unsigned int k = 0; k < 3; ++k)
      {
        last = std::max(last, line * (f.vertices()[k] - f.centre()) / distance);
        first = std::min(first, line * (g.vertices()[k] - f.centre()) / distance);
      }
      return first - last >= 1;
    }

    /// Makes edges that are parallel to the digits of double so to all digits, by a move of a
    /// vertex of g by a rounding of its coordinates. Faces that are not parallel have at most
    /// one such pair.
    /// @return  whether there is one
    template <class Real>
    bool align(const FormFace<Real> &f, FormFace<Real> &g)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const Vector<Real> a = f.edge(i), b = g.edge(j);
          constexpr double alike = 1e-15;
          if (g.is_shared_edge(j, f) || a.cross(b).norm() > alike * (a.norm() + b.norm()))
            continue;
          const Vector<Real> along = a * (a.dot(b) / a.dot(a));
          const unsigned int end = FormFace<Real>::next(j);
          if (f.shares(g.names[end]))
            g.x[j] = g.x[end] - along;
          else
            g.x[end] = g.x[j] + along;
          return true;
        }
      return false;
    }

    double gap(const PairFace &f, const PairFace &g)
    {
      return f.centre().distance(g.centre()) - f.radius() - g.radius();
    }

    struct NothingShared
    {
      template <class Make>
      auto edges(unsigned int, unsigned int, bool, const Make &make) const
      {
        return make();
      }
      template <class Make>
      auto first_vertex(unsigned int, unsigned int, bool, const Make &make) const
      {
        return make();
      }
      template <class Make>
      auto second_vertex(unsigned int, bool, const Make &make) const
      {
        return make();
      }
      template <class Make>
      auto parallel(unsigned int, unsigned int, const Make &make) const
      {
        return make();
      }
    };

    template <class Real>
    Sum<Real> integrate(const std::vector<PotentialPart<Real>> &parts, const PairFace &f,
                        const PairFace &g, double parallel = rounding)
    {
      NothingShared nothing;
      PairForm<Real, NothingShared> form(parts, gap(f, g) > compact_from, nothing);
      return form(form_face<Real>(f), form_face<Real>(g), parallel);
    }

    /// Few values that pairs share, by numbers.
    template <class Real>
    class RareValues
    {
    public:
      void clear()
      {
        of_edges_.clear();
        of_vertices_.clear();
        parallel_.clear();
      }
      void set_face(unsigned int face) { face_ = face; } ///< of second_vertex()

      template <class Make>
      Sum<Real> edges(unsigned int e, unsigned int f, bool is_compact, const Make &make)
      {
        return take(of_edges_, e, f, is_compact, make);
      }
      template <class Make>
      Sum<Real> first_vertex(unsigned int v, unsigned int face, bool is_compact, const Make &make)
      {
        return take(of_vertices_, v, face, is_compact, make);
      }
      template <class Make>
      Sum<Real> second_vertex(unsigned int v, bool is_compact, const Make &make)
      {
        return take(of_vertices_, v, face_, is_compact, make);
      }
      template <class Make>
      Sum<Real> parallel(unsigned int e, unsigned int face, const Make &make)
      {
        return take(parallel_, e, face, false, make);
      }

    private:
      using Values = std::unordered_map<std::uint64_t, Sum<Real>>;

      template <class Make>
      static Sum<Real> take(Values &values, unsigned int first, unsigned int second,
                            bool is_compact, const Make &make)
      {
        constexpr unsigned int half = 32;
        const std::uint64_t key = (static_cast<std::uint64_t>(first) << half) +
                                  2 * static_cast<std::uint64_t>(second) + (is_compact ? 1 : 0);
        const auto found = values.find(key);
        return found != values.end() ? found->second : values[key] = make();
      }

      Values of_edges_, of_vertices_, parallel_;
      unsigned int face_ = 0;
    };

    template <class Real>
    std::vector<PotentialPart<Real>> make_parts(const std::vector<PotentialTerms> &terms, int order)
    {
      std::vector<PotentialPart<Real>> parts;
      for (const PotentialTerms &part : terms)
        parts.emplace_back(part, order);
      return parts;
    }
  } // namespace

  struct ExactPairs::Parts
  {
    std::vector<PotentialPart<double>> usual;
    std::vector<PotentialPart<long double>> longer;
    std::vector<PotentialPart<Quad>> quad;
    std::vector<PotentialPart<Octuple>> octuple;
  };

  /// Rows of a table for what belongs to the first faces, columns for all.
  struct ExactPairs::Shared::Tables
  {
    enum class State : std::uint8_t
    {
      unknown,
      regular,
      compact
    };
    struct Slot
    {
      double value = 0;
      float size = 0;
      State state = State::unknown;
    };
    /// Numbers of things counted anew, in the order in which they are met.
    struct Places
    {
      std::vector<unsigned int> place, met; ///< place + 1, or 0

      void clear()
      {
        for (const unsigned int number : met)
          place[number] = 0;
        met.clear();
      }
      void add(unsigned int number)
      {
        if (place.size() <= number)
          place.resize(number + number / 2 + 1);
        if (place[number] == 0)
        {
          met.push_back(number);
          place[number] = static_cast<unsigned int>(met.size());
        }
      }
      std::size_t operator[](unsigned int number) const { return place[number] - 1; }
      std::size_t size() const { return met.size(); }
    };

    template <class Make>
    static Sum<double> take(Slot &slot, bool is_compact, const Make &make)
    {
      const State state = is_compact ? State::compact : State::regular;
      if (slot.state != state)
      {
        const Sum<double> made = make();
        slot = {made.value, static_cast<float>(made.size), state};
      }
      return {slot.value, slot.size};
    }

    template <class Make>
    Sum<double> edges(unsigned int e, unsigned int f, bool is_compact, const Make &make)
    {
      return take(of_edges[edge_rows[e] * edge_columns.size() + edge_columns[f]], is_compact, make);
    }
    template <class Make>
    Sum<double> first_vertex(unsigned int v, unsigned int face, bool is_compact, const Make &make)
    {
      return take(of_vertices[vertex_rows[v] * faces.size() + faces[face]], is_compact, make);
    }
    template <class Make>
    Sum<double> second_vertex(unsigned int v, bool is_compact, const Make &make)
    {
      return take(of_face[vertices[v]], is_compact, make);
    }
    template <class Make>
    Sum<double> parallel(unsigned int e, unsigned int face, const Make &make)
    {
      return rare.parallel(e, face, make);
    }

    Places edge_rows, edge_columns, vertex_rows, vertices, faces;
    std::vector<Slot> of_edges, of_vertices, of_face;
    RareValues<double> rare;
    RareValues<long double> longer;
    const NumberedFace *face = nullptr; ///< that of_face is of
  };

  ExactPairs::Shared::Shared() : tables_(std::make_unique<Tables>()) {}
  ExactPairs::Shared::~Shared() = default;
  ExactPairs::Shared::Shared(Shared &&) noexcept = default;

  void ExactPairs::Shared::start(const std::vector<const NumberedFace *> &first,
                                 const std::vector<const NumberedFace *> &second)
  {
    Tables &t = *tables_;
    for (Tables::Places *places :
         {&t.edge_rows, &t.edge_columns, &t.vertex_rows, &t.vertices, &t.faces})
      places->clear();
    for (const NumberedFace *face : first)
      for (unsigned int k = 0; k < 3; ++k)
      {
        t.edge_rows.add(face->edges[k]);
        t.vertex_rows.add(face->face->names()[k]);
      }
    for (const NumberedFace *face : second)
    {
      t.faces.add(face->number);
      for (unsigned int k = 0; k < 3; ++k)
      {
        t.edge_columns.add(face->edges[k]);
        t.vertices.add(face->face->names()[k]);
      }
    }
    t.of_edges.assign(t.edge_rows.size() * t.edge_columns.size(), {});
    t.of_vertices.assign(t.vertex_rows.size() * t.faces.size(), {});
    t.rare.clear();
    t.longer.clear();
    t.face = nullptr;
  }

  ExactPairs::ExactPairs(const physics::Kernel<3> &kernel, FacePotential::Kind kind,
                         double tolerance)
      : tolerance_(tolerance)
  {
    const auto terms = FacePotential::terms(kernel);
    const int order = kind == FacePotential::Kind::harmonic ? 1 : 3;
    parts_ = std::make_unique<const Parts>(
        Parts{make_parts<double>(terms, order), make_parts<long double>(terms, order),
              make_parts<Quad>(terms, order), make_parts<Octuple>(terms, order)});
  }

  ExactPairs::~ExactPairs() = default;

  namespace
  {
    /// Of the round-off unit times the sum of terms' sizes. Measured on random pairs: 1 to 20 where
    /// it matters.
    constexpr double safety = 16;

    template <class Real>
    double bound(const Sum<Real> &sum)
    {
      return static_cast<double>(safety * std::numeric_limits<Real>::epsilon() * sum.size);
    }
  } // namespace

  ExactPairs::Integral ExactPairs::operator()(const NumberedFace &f, const NumberedFace &g,
                                              Shared &shared) const
  {
    const double distance = gap(*f.face, *g.face);
    if (distance >= 1 || are_out_of_reach(*f.face, *g.face))
      return {};
    Shared::Tables &tables = *shared.tables_;
    if (tables.face != &f)
    {
      tables.face = &f;
      tables.of_face.assign(tables.vertices.size(), {});
      tables.longer.set_face(f.number);
    }
    const bool is_compact = distance > compact_from;
    PairForm<double, Shared::Tables> form(parts_->usual, is_compact, tables);
    const Sum<double> sum = form(form_face<double>(f), form_face<double>(g), rounding);
    if (const double error = bound(sum); error <= tolerance_)
      return {sum.value, error, 0};
    PairForm<long double, RareValues<long double>> longer(parts_->longer, is_compact,
                                                          tables.longer);
    const Sum<long double> refined =
        longer(form_face<long double>(f), form_face<long double>(g), rounding);
    if (const double error = bound(refined); error <= tolerance_)
      return {static_cast<double>(refined.value), error, 1};
    return precise_enough(*f.face, *g.face);
  }

  ExactPairs::Integral ExactPairs::precise_enough(const PairFace &f, const PairFace &g) const
  {
    NothingShared nothing;
    PairForm<Quad, NothingShared> form(parts_->quad, gap(f, g) > compact_from, nothing);
    const FormFace<Quad> x = form_face<Quad>(f);
    FormFace<Quad> y = form_face<Quad>(g);
    const double parallel = align(x, y) ? least_rounding : rounding;
    const Sum<Quad> precise = form(x, y, parallel);
    if (const double error = bound(precise); error <= tolerance_)
      return {static_cast<double>(precise.value), error, 2};
    const Sum<Octuple> last = integrate(parts_->octuple, f, g, no_rounding);
    return {static_cast<double>(last.value), bound(last), 3};
  }

  ExactPairs::Integral ExactPairs::operator()(const PairFace &f, const PairFace &g) const
  {
    if (gap(f, g) >= 1 || are_out_of_reach(f, g))
      return {};
    const Sum<double> sum = integrate(parts_->usual, f, g);
    if (const double error = bound(sum); error <= tolerance_)
      return {sum.value, error, 0};
    const Sum<long double> refined = integrate(parts_->longer, f, g);
    if (const double error = bound(refined); error <= tolerance_)
      return {static_cast<double>(refined.value), error, 1};
    return precise_enough(f, g);
  }

  double ExactPairs::precise(const PairFace &f, const PairFace &g) const
  {
    return static_cast<double>(integrate(parts_->octuple, f, g, no_rounding).value);
  }
} // namespace plumbline::reference
