#include "meshfree/fracture/network_motion.h"

#include "meshfree/fracture/breaking_network.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double endless = std::numeric_limits<double>::infinity();

    double square(double x)
    {
      return x * x;
    }

    /// x·Δu of a bond.
    template <class Link>
    double along(const Link &link, const double *x, const std::vector<double> &all)
    {
      const double *const from = all.data() + 2 * static_cast<std::size_t>(link.from),
                          *const to = all.data() + 2 * static_cast<std::size_t>(link.to);
      return x[0] * (to[0] - from[0]) + x[1] * (to[1] - from[1]);
    }
  } // namespace

  NetworkMotion::NetworkMotion(std::shared_ptr<const BondNetwork<2>> network)
      : network_(std::move(network)), volume_(network_->h * network_->h)
  {
    n_free_ =
        static_cast<std::size_t>(std::count(network_->grip.begin(), network_->grip.end(), -1));
    links_.reserve(network_->bonds.size());
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
    {
      const BondNetwork<2>::Bond &bond = network_->bonds[b];
      links_.push_back({bond.from,
                        bond.to,
                        {bond.xi[0], bond.xi[1]},
                        {bond.way[0], bond.way[1]},
                        bond.stiffness,
                        bond.share,
                        bond.critical < endless ? bond.critical * bond.xi.norm_square() : endless,
                        b});
    }
  }

  std::vector<double> NetworkMotion::with_grips(const State &u, const std::vector<double> &g) const
  {
    std::vector<double> all(g);
    std::size_t next = 0;
    for (std::size_t i = 0; i < network_->nodes.size(); ++i)
      if (is_free(i))
        for (std::size_t c = 0; c < 2; ++c)
          all[2 * i + c] = u[next++];
    return all;
  }

  std::vector<double> NetworkMotion::dilatations(const std::vector<double> &all) const
  {
    std::vector<double> theta(network_->dilatation.size());
    if (theta.empty())
      return theta;
    for (const Link &link : links_)
    {
      const double part = link.share * along(link, link.xi, all);
      theta[link.from] += part;
      theta[link.to] += part;
    }
    return theta;
  }

  double NetworkMotion::energy(const std::vector<double> &all) const
  {
    double sum = 0;
    for (const Link &link : links_)
      sum += .5 * link.stiffness * square(along(link, link.way, all));
    const std::vector<double> theta = dilatations(all);
    for (std::size_t i = 0; i < theta.size(); ++i)
      sum += .5 * network_->dilatation[i] * square(theta[i]);
    return sum;
  }

  void NetworkMotion::forces(const std::vector<double> &all, std::vector<double> &f) const
  {
    std::vector<double> pressure = dilatations(all);
    for (std::size_t i = 0; i < pressure.size(); ++i)
      pressure[i] *= network_->dilatation[i];
    f.assign(all.size(), 0);
    for (const Link &link : links_)
    {
      const double pull = link.stiffness * along(link, link.way, all),
                   push = pressure.empty() ? 0
                                           : link.share * (pressure[link.from] + pressure[link.to]);
      double *const from = f.data() + 2 * static_cast<std::size_t>(link.from),
                    *const to = f.data() + 2 * static_cast<std::size_t>(link.to);
      for (std::size_t c = 0; c < 2; ++c)
      {
        const double force = pull * link.way[c] + push * link.xi[c];
        from[c] += force;
        to[c] -= force;
      }
    }
  }

  const std::vector<double> &NetworkMotion::forces(const State &u,
                                                   const std::vector<double> &g) const
  {
    if (!forces_.empty() && u == u_ && g == g_)
      return forces_;
    u_ = u;
    g_ = g;
    forces(with_grips(u, g), forces_);
    return forces_;
  }

  void NetworkMotion::acceleration(const State &u, const std::vector<double> &g, State &a) const
  {
    const std::vector<double> &f = forces(u, g);
    std::size_t next = 0;
    for (std::size_t i = 0; i < network_->nodes.size(); ++i)
      if (is_free(i))
        for (std::size_t c = 2 * i; c < 2 * i + 2; ++c)
          a[next++] = f[c] / volume_ + g[c];
  }

  void NetworkMotion::tangent(const State & /*u*/, const std::vector<double> & /*g*/,
                              const State &v, State &out) const
  {
    std::vector<double> f;
    forces(with_grips(v, std::vector<double>(2 * network_->nodes.size())), f);
    std::size_t next = 0;
    for (std::size_t i = 0; i < network_->nodes.size(); ++i)
      if (is_free(i))
        for (std::size_t c = 2 * i; c < 2 * i + 2; ++c)
          out[next++] = f[c] / volume_;
  }

  double NetworkMotion::product(const State &u, const State &v) const
  {
    double sum = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      sum += u[i] * v[i];
    return volume_ * sum;
  }

  double NetworkMotion::energy(const State &u, const std::vector<double> &g) const
  {
    return energy(with_grips(u, g));
  }

  double NetworkMotion::power(const State &u, const State &v, const std::vector<double> &g,
                              const std::vector<double> &rate) const
  {
    const std::vector<double> &f = forces(u, g);
    double sum = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < network_->nodes.size(); ++i)
      for (std::size_t c = 2 * i; c < 2 * i + 2; ++c)
        sum += is_free(i) ? volume_ * g[c] * v[next++] : -f[c] * rate[c];
    return sum;
  }

  NetworkMotion::Breaks NetworkMotion::break_bonds(const State &u, const std::vector<double> &g)
  {
    const std::vector<double> all = with_grips(u, g);
    Breaks breaks;
    for (const Link &link : links_)
      if (const double pull = along(link, link.xi, all); pull >= link.limit)
      {
        breaks.bonds.push_back(link.bond);
        breaks.overshoot += pull / link.limit - 1;
      }
    if (breaks.bonds.empty())
      return breaks;
    const double before = energy(all);
    remove(breaks.bonds);
    breaks.energy = before - energy(all);
    return breaks;
  }

  void NetworkMotion::restart(const std::vector<std::size_t> &broken)
  {
    remove(broken);
  }

  void NetworkMotion::remove(const std::vector<std::size_t> &bonds)
  {
    std::vector<char> is_broken(network_->bonds.size(), 0);
    for (const std::size_t bond : bonds)
      is_broken[bond] = 1;
    links_.erase(std::remove_if(links_.begin(), links_.end(),
                                [&](const Link &link) { return is_broken[link.bond] != 0; }),
                 links_.end());
    forces_.clear();
  }

  std::vector<double> NetworkMotion::displacements(const State &u,
                                                   const std::vector<double> &g) const
  {
    return with_grips(u, g);
  }

  method::MovingBody moving_body(BondNetwork<2> network, const dealii::Point<2> &notch_tip)
  {
    const auto shared = std::make_shared<const BondNetwork<2>>(std::move(network));
    return {std::make_unique<NetworkMotion>(shared), nodes_and_bonds<2>(shared, notch_tip)};
  }
} // namespace plumbline::meshfree
