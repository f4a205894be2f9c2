#include "reference/tetrahedra/exact_pairs.h"

#include "reference/tetrahedra/pair_form.h"
#include "reference/tetrahedra/plane_sums.h"
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

    const PairFace &pair_face(const PairFace &face)
    {
      return face;
    }
    const PairFace &pair_face(const NumberedFace &face)
    {
      return *face.face;
    }

    double gap(const PairFace &f, const PairFace &g)
    {
      return f.centre().distance(g.centre()) - f.radius() - g.radius();
    }

    /// Whether functions that are singular at 0 are taken.
    bool is_far(const PairFace &f, const PairFace &g)
    {
      return gap(f, g) > compact_from;
    }

    struct NothingShared
    {
      template <class Factor, class Make>
      auto edges(unsigned int, unsigned int, bool, const Factor &, const Make &make) const
      {
        return make();
      }
      template <class Factor, class Make>
      auto first_vertex(unsigned int, unsigned int, bool, const Factor &, const Make &make) const
      {
        return make();
      }
      template <class Factor, class Make>
      auto second_vertex(unsigned int, bool, const Factor &, const Make &make) const
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
      PairForm<Real, NothingShared> form(parts, is_far(f, g), nothing);
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
      Sum<Real> edges(unsigned int e, unsigned int f, bool is_compact, const Real & /*factor*/,
                      const Make &make)
      {
        return take(of_edges_, e, f, is_compact, make);
      }
      template <class Make>
      Sum<Real> first_vertex(unsigned int v, unsigned int face, bool is_compact,
                             const Real & /*factor*/, const Make &make)
      {
        return take(of_vertices_, v, face, is_compact, make);
      }
      template <class Make>
      Sum<Real> second_vertex(unsigned int v, bool is_compact, const Real & /*factor*/,
                              const Make &make)
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

    /// Of the round-off unit times the sum of terms' sizes. Measured on random pairs: 1 to 20 where
    /// it matters.
    constexpr double safety = 16;

    /// Single values of faces about a horizon apart, and of regular functions that cancel, have
    /// more round-off than that: up to 50 times as much among 10^5 pairs. In sums in double other
    /// terms outweigh them; sums with more digits may have no others in double.
    constexpr double margin = 32;

    template <class Real>
    double bound(const Sum<Real> &sum)
    {
      return static_cast<double>(safety * std::numeric_limits<Real>::epsilon() * sum.size);
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

    SharedSum &at_edges(unsigned int e, unsigned int f, bool is_compact)
    {
      return of_edges[is_compact ? 1 : 0][edge_rows[e] * edge_columns.size() + edge_columns[f]];
    }
    SharedSum &at_first_vertex(unsigned int v, unsigned int face, bool is_compact)
    {
      return of_vertices[is_compact ? 1 : 0][vertex_rows[v] * faces.size() + faces[face]];
    }
    SharedSum &at_second_vertex(unsigned int v, bool is_compact)
    {
      return of_face[is_compact ? 1 : 0][vertices[v]];
    }

    template <class Make>
    static Sum<double> take(SharedSum &shared, const Make &make)
    {
      if (!shared.is_known)
      {
        const Sum<double> made = make();
        shared = {made.value, static_cast<float>(made.size), true};
      }
      return {shared.value, shared.size};
    }

    template <class Make>
    Sum<double> edges(unsigned int e, unsigned int f, bool is_compact, const double & /*factor*/,
                      const Make &make)
    {
      return take(at_edges(e, f, is_compact), make);
    }
    template <class Make>
    Sum<double> first_vertex(unsigned int v, unsigned int face, bool is_compact,
                             const double & /*factor*/, const Make &make)
    {
      return take(at_first_vertex(v, face, is_compact), make);
    }
    template <class Make>
    Sum<double> second_vertex(unsigned int v, bool is_compact, const double & /*factor*/,
                              const Make &make)
    {
      return take(at_second_vertex(v, is_compact), make);
    }
    template <class Make>
    Sum<double> parallel(unsigned int e, unsigned int face, const Make &make)
    {
      return rare.parallel(e, face, make);
    }

    Places edge_rows, edge_columns, vertex_rows, vertices, faces;
    using Values = std::array<std::vector<SharedSum>, 2>; ///< of regular and compact functions
    Values of_edges, of_vertices, of_face;
    /// A second face, with its columns in the tables.
    struct Second
    {
      std::array<Vector<double>, 3> x;
      Vector<double> normal; ///< of length 1
      std::array<unsigned int, 3> names{};
      std::array<std::size_t, 3> edges{}, vertices{};
    };
    std::vector<Second> second; ///< by faces' places

    void look_at(const NumberedFace &f)
    {
      if (face == &f)
        return;
      face = &f;
      for (auto &values : of_face)
        values.assign(vertices.size(), {});
      longer.set_face(f.number);
      quad.set_face(f.number);
    }
    RareValues<double> rare;
    RareValues<long double> longer;
    RareValues<Quad> quad;
    const NumberedFace *face = nullptr; ///< that of_face is of
  };

  /// Terms of a sum with more digits that are small enough, with their factors, for values in
  /// double; others are made.
  template <class Real>
  class ExactPairs::Mixed
  {
  public:
    Mixed(Shared::Tables &tables, RareValues<Real> &made, double tolerance)
        : tables_(tables), made_(made), least_(tolerance / (n_terms * margin))
    {
    }

    template <class Make>
    Sum<Real> edges(unsigned int e, unsigned int f, bool is_compact, const Real &factor,
                    const Make &make)
    {
      return is_enough(tables_.at_edges(e, f, is_compact), factor)
                 ? in_double(tables_.at_edges(e, f, is_compact))
                 : made_.edges(e, f, is_compact, factor, make);
    }
    template <class Make>
    Sum<Real> first_vertex(unsigned int v, unsigned int face, bool is_compact, const Real &factor,
                           const Make &make)
    {
      return is_enough(tables_.at_first_vertex(v, face, is_compact), factor)
                 ? in_double(tables_.at_first_vertex(v, face, is_compact))
                 : made_.first_vertex(v, face, is_compact, factor, make);
    }
    template <class Make>
    Sum<Real> second_vertex(unsigned int v, bool is_compact, const Real &factor, const Make &make)
    {
      return is_enough(tables_.at_second_vertex(v, is_compact), factor)
                 ? in_double(tables_.at_second_vertex(v, is_compact))
                 : made_.second_vertex(v, is_compact, factor, make);
    }
    template <class Make>
    Sum<Real> parallel(unsigned int e, unsigned int face, const Make &make)
    {
      return made_.parallel(e, face, make);
    }

  private:
    static constexpr double n_terms = 16; // a sum has 15 at most

    bool is_enough(const SharedSum &sum, const Real &factor) const
    {
      return sum.is_known &&
             bound(Sum<double>{0, std::abs(static_cast<double>(factor)) * sum.size}) < least_;
    }
    /// With the size that has its round-off.
    static Sum<Real> in_double(const SharedSum &sum)
    {
      const Real ratio =
          Real(std::numeric_limits<double>::epsilon()) / std::numeric_limits<Real>::epsilon();
      return {sum.value, margin * ratio * Real(sum.size)};
    }

    Shared::Tables &tables_;
    RareValues<Real> &made_;
    double least_;
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
    for (unsigned int kind = 0; kind < 2; ++kind)
    {
      t.of_edges[kind].assign(t.edge_rows.size() * t.edge_columns.size(), {});
      t.of_vertices[kind].assign(t.vertex_rows.size() * t.faces.size(), {});
    }
    t.second.clear();
    for (const NumberedFace *face : second)
    {
      FormFace<double> measured = form_face<double>(*face);
      measured.measure();
      Tables::Second &own = t.second.emplace_back();
      own.x = measured.x;
      own.normal = measured.normal;
      own.names = measured.names;
      for (unsigned int k = 0; k < 3; ++k)
      {
        own.edges[k] = t.edge_columns[face->edges[k]];
        own.vertices[k] = t.vertices[own.names[k]];
      }
    }
    t.rare.clear();
    t.longer.clear();
    t.quad.clear();
    t.face = nullptr;
  }

  ExactPairs::ExactPairs(const PotentialKernel &kernel, FacePotential::Kind kind, double tolerance)
      : tolerance_(tolerance)
  {
    const std::vector<PotentialTerms> &terms = kernel.terms;
    const int order = kind == FacePotential::Kind::harmonic ? 1 : 3;
    parts_ = std::make_unique<const Parts>(
        Parts{make_parts<double>(terms, order), make_parts<long double>(terms, order),
              make_parts<Quad>(terms, order), make_parts<Octuple>(terms, order)});
  }

  ExactPairs::~ExactPairs() = default;

  ExactPairs::Integral ExactPairs::operator()(const NumberedFace &f, const NumberedFace &g,
                                              Shared &shared) const
  {
    const double distance = gap(*f.face, *g.face);
    if (distance >= 1 || are_out_of_reach(*f.face, *g.face))
      return {};
    Shared::Tables &tables = *shared.tables_;
    tables.look_at(f);
    const bool is_compact = is_far(*f.face, *g.face);
    PairForm<double, Shared::Tables> form(parts_->usual, is_compact, tables);
    const Sum<double> sum = form(form_face<double>(f), form_face<double>(g), rounding);
    if (const double error = bound(sum); error <= tolerance_)
      return {sum.value, error, 0};
    return refined(f, g, is_compact, shared);
  }

  ExactPairs::Integral ExactPairs::refined(const NumberedFace &f, const NumberedFace &g,
                                           bool is_compact, Shared &shared) const
  {
    Shared::Tables &tables = *shared.tables_;
    Mixed<long double> values(tables, tables.longer, tolerance_);
    PairForm<long double, Mixed<long double>> form(parts_->longer, is_compact, values);
    const Sum<long double> sum =
        form(form_face<long double>(f), form_face<long double>(g), rounding);
    if (const double error = bound(sum); error <= tolerance_)
      return {static_cast<double>(sum.value), error, 1};
    Mixed<Quad> more(tables, tables.quad, tolerance_);
    return precise_enough(f, g, is_compact, more);
  }

  template <class Face, class Values>
  ExactPairs::Integral ExactPairs::precise_enough(const Face &f, const Face &g, bool is_compact,
                                                  Values &values) const
  {
    const FormFace<Quad> x = form_face<Quad>(f);
    FormFace<Quad> y = form_face<Quad>(g);
    Sum<Quad> precise;
    if (align(x, y)) // no longer the faces that values are of
    {
      NothingShared nothing;
      PairForm<Quad, NothingShared> form(parts_->quad, is_compact, nothing);
      precise = form(x, y, least_rounding);
    }
    else
    {
      PairForm<Quad, Values> form(parts_->quad, is_compact, values);
      precise = form(x, y, rounding);
    }
    if (const double error = bound(precise); error <= tolerance_)
      return {static_cast<double>(precise.value), error, 2};
    const Sum<Octuple> last = integrate(parts_->octuple, pair_face(f), pair_face(g), no_rounding);
    return {static_cast<double>(last.value), bound(last), 3};
  }

  /// Pairs of one face with others, in general position, in double.
  class ExactPairs::Batch
  {
  public:
    /// @param is_usual  whether functions are those of take_compact(), or the others
    Batch(const Parts &parts, const NumberedFace &f, bool is_usual, Shared::Tables &tables)
        : sums_(parts.usual), f_(f), is_usual_(is_usual), tables_(tables),
          measured_(form_face<double>(f))
    {
      measured_.measure();
      const auto put = [](const Vector<double> &from, double(&to)[3]) // NOLINT
      {
        to[0] = from.x;
        to[1] = from.y;
        to[2] = from.z;
      };
      for (unsigned int k = 0; k < 3; ++k)
        put(measured_.x[k], first_.x[k]);
      put(measured_.normal, first_.normal);
      for (unsigned int kind = 0; kind < 2; ++kind)
      {
        for (unsigned int k = 0; k < 3; ++k)
        {
          rows_[kind].of_edges[k] =
              &tables.of_edges[kind][tables.edge_rows[f.edges[k]] * tables.edge_columns.size()];
          rows_[kind].of_vertices[k] =
              &tables
                   .of_vertices[kind][tables.vertex_rows[f.face->names()[k]] * tables.faces.size()];
        }
        rows_[kind].of_face = tables.of_face[kind].data();
      }
    }

    /// How a pair is to be integrated.
    enum class Way
    {
      batch,
      alone,
      vanishes
    };

    /// Of all pairs that ways[k] = batch.
    void run(const std::vector<const NumberedFace *> &others, std::vector<Way> &ways,
             std::vector<Sum<double>> &result)
    {
      ways.clear();
      terms_.reserve(others.size());
      for (std::size_t first = 0; first < others.size(); first += n_lanes)
      {
        const std::size_t last = std::min(first + n_lanes, others.size());
        for (std::size_t k = first; k < last; ++k)
          set(*others[k], static_cast<unsigned int>(k - first));
        find_factors(first_, rounding, lanes_);
        for (std::size_t k = first; k < last; ++k)
          ways.push_back(add_pair(*others[k], static_cast<unsigned int>(k - first)));
      }
      sums_.finish();
      result.assign(others.size(), {});
      auto terms = terms_.begin();
      for (std::size_t k = 0; k < others.size(); ++k)
        if (ways[k] == Way::batch)
          result[k] = (terms++)->sum();
    }

  private:
    using Second = Shared::Tables::Second;
    static constexpr unsigned int most_terms = 15;
    struct Terms
    {
      double growth = 1;
      unsigned int n = 0;
      std::array<double, most_terms> factors;
      std::array<const SharedSum *, most_terms> values;

      void add(double factor, const SharedSum &value)
      {
        factors[n] = factor;
        values[n++] = &value;
      }
      Sum<double> sum() const
      {
        Sum<double> sum;
        for (unsigned int k = 0; k < n; ++k)
        {
          sum.value += factors[k] * values[k]->value;
          sum.size += std::abs(factors[k]) * values[k]->size;
        }
        sum.size *= growth;
        return sum;
      }
    };

    static void put(const Vector<double> &from, Lanes (&to)[3], unsigned int lane) // NOLINT
    {
      to[0][lane] = from.x;
      to[1][lane] = from.y;
      to[2][lane] = from.z;
    }

    const Second &second(const NumberedFace &g) const
    {
      return tables_.second[tables_.faces[g.number]];
    }

    void set(const NumberedFace &other, unsigned int lane)
    {
      const Second &g = second(other);
      unsigned int base = 0, base_of_first = 0;
      for (unsigned int k = 0; k < 3; ++k)
      {
        put(g.x[k], lanes_.x[k], lane);
        lanes_.is_own[k][lane] = measured_.shares(g.names[k]) ? 0 : 1;
        const unsigned int name = measured_.names[k];
        const bool is_shared = g.names[0] == name || g.names[1] == name || g.names[2] == name;
        lanes_.is_own_first[k][lane] = is_shared ? 0 : 1;
        if (lanes_.is_own[k][lane] == 0)
          base = k;
        if (lanes_.is_own_first[k][lane] == 0)
          base_of_first = k;
      }
      put(g.normal, lanes_.normal, lane);
      put(g.x[base], lanes_.base, lane);
      put(measured_.x[base_of_first], lanes_.base_of_first, lane);
    }

    /// Parallel edges, except shared ones, have a form of their own.
    bool is_general(unsigned int lane) const
    {
      double n_parallel = 0, n_parallel_first = 0;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int end = FormFace<double>::next(k);
        const double of_g = lanes_.is_parallel[k][lane], of_f = lanes_.is_parallel_first[k][lane];
        if (of_g != 0 && lanes_.is_own[k][lane] + lanes_.is_own[end][lane] != 0)
          return false;
        if (of_f != 0 && lanes_.is_own_first[k][lane] + lanes_.is_own_first[end][lane] != 0)
          return false;
        n_parallel += of_g;
        n_parallel_first += of_f;
      }
      return n_parallel < 3 && n_parallel_first < 3;
    }

    Way add_pair(const NumberedFace &other, unsigned int lane)
    {
      const double distance = gap(*f_.face, *other.face);
      if (distance >= 1 || lanes_.separation[lane] >= 1)
        return Way::vanishes;
      if (!is_general(lane))
        return Way::alone;
      const bool is_compact = (distance > compact_from) == is_usual_;
      const std::size_t place = tables_.faces[other.number];
      const Second &g = tables_.second[place];
      Terms &terms = terms_.emplace_back();
      terms.growth = lanes_.growth[lane];
      const Rows &rows = rows_[is_compact ? 1 : 0];
      for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          if (const double factor = lanes_.edges[i][j][lane]; factor != 0)
            terms.add(factor, edge_pair(rows.of_edges[i][g.edges[j]], i, g, j, is_compact));
        if (const double factor = lanes_.first[i][lane]; factor != 0)
          terms.add(factor,
                    vertex(rows.of_vertices[i][place], measured_.x[i], g.x, g.normal, is_compact));
        if (const double factor = lanes_.second[i][lane]; factor != 0)
          terms.add(factor, vertex(rows.of_face[g.vertices[i]], g.x[i], measured_.x,
                                   measured_.normal, is_compact));
      }
      return Way::batch;
    }

    const SharedSum &edge_pair(SharedSum &sum, unsigned int i, const Second &g, unsigned int j,
                               bool is_compact)
    {
      if (!sum.is_known)
        sums_.add_parallelogram(g.x[j] - measured_.x[i], measured_.edge(i),
                                g.x[FormFace<double>::next(j)] - g.x[j], is_compact, sum);
      sum.is_known = true;
      return sum;
    }
    const SharedSum &vertex(SharedSum &sum, const Vector<double> &v,
                            const std::array<Vector<double>, 3> &x, const Vector<double> &normal,
                            bool is_compact)
    {
      if (!sum.is_known)
        sums_.add_triangle({x[0] - v, x[1] - v, x[2] - v}, normal, is_compact, sum);
      sum.is_known = true;
      return sum;
    }

    /// The rows of a face in the tables.
    struct Rows
    {
      std::array<SharedSum *, 3> of_edges{}, of_vertices{};
      SharedSum *of_face = nullptr;
    };

    PlaneSums sums_;
    const NumberedFace &f_;
    bool is_usual_;
    Shared::Tables &tables_;
    FormFace<double> measured_;
    FirstFace first_{};
    std::array<Rows, 2> rows_; ///< of regular and compact functions
    PairLanes lanes_{};
    std::vector<Terms> terms_;
  };

  void ExactPairs::operator()(const NumberedFace &f,
                              const std::vector<const NumberedFace *> &others, Shared &shared,
                              std::vector<Integral> &result) const
  {
    Shared::Tables &tables = *shared.tables_;
    tables.look_at(f);
    result.assign(others.size(), {});
    std::vector<Batch::Way> ways;
    std::vector<Sum<double>> sums;
    Batch(*parts_, f, true, tables).run(others, ways, sums);
    // where a sum of compact functions has too much round-off, terms of regular ones may cancel
    // less; compact ones are for faces that are far from each other
    std::vector<std::size_t> places;
    std::vector<const NumberedFace *> again;
    for (std::size_t k = 0; k < others.size(); ++k)
    {
      if (ways[k] == Batch::Way::alone)
        result[k] = (*this)(f, *others[k], shared);
      if (ways[k] != Batch::Way::batch)
        continue;
      result[k] = {sums[k].value, bound(sums[k]), 0};
      if (result[k].error <= tolerance_)
        continue;
      if (is_far(*f.face, *others[k]->face))
      {
        places.push_back(k);
        again.push_back(others[k]);
      }
      else
        result[k] = refined(f, *others[k], is_far(*f.face, *others[k]->face), shared);
    }
    if (again.empty())
      return;
    Batch(*parts_, f, false, tables).run(again, ways, sums);
    for (std::size_t k = 0; k < again.size(); ++k)
    {
      Integral &best = result[places[k]];
      const bool is_compact = is_far(*f.face, *again[k]->face) == !(bound(sums[k]) < best.error);
      if (bound(sums[k]) < best.error)
        best = {sums[k].value, bound(sums[k]), 0};
      if (best.error > tolerance_)
        best = refined(f, *again[k], is_compact, shared);
    }
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
    NothingShared nothing;
    return precise_enough(f, g, is_far(f, g), nothing);
  }

  double ExactPairs::precise(const PairFace &f, const PairFace &g) const
  {
    return static_cast<double>(integrate(parts_->octuple, f, g, no_rounding).value);
  }
} // namespace plumbline::reference
