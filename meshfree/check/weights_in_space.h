#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/periodic_box.h"
#include "meshfree/check/bond_check.h"
#include "meshfree/check/elastic_check.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// Weights of another code in space.
  struct WeightsInSpace
  {
    std::vector<std::int64_t> id;                ///< of all nodes, in the order of their file
    std::vector<Point<3>> places;                ///< [length]
    std::vector<double> volumes;                 ///< [length^3]
    std::vector<std::size_t> free;               ///< nodes in Ω
    std::vector<Family<3>> families;             ///< of these; neighbours are indices of nodes
    std::vector<std::vector<std::size_t>> lines; ///< of their bonds in the file
    double rounding = 0; ///< of the weights by their digits, relative to most of them
    /// Where Ω is periodic; bonds are to the nearest images then.
    std::optional<geometry::PeriodicBox<3>> box;

    /// From a node to its neighbour [length].
    Point<3> vector_between(std::size_t i, std::size_t j) const;
  };

  /// A bond as it is given.
  struct BondInSpace
  {
    std::size_t i = 0, j = 0;             ///< indices of nodes
    double weight = 0;                    ///< [length^3]
    std::optional<Point<3>> kernel_point; ///< relative to node i; empty: at node j [length]
    std::size_t line = 0;
  };

  /// The families of nodes in Ω. Bonds of other nodes are left out.
  /// @param given  with nodes and, where Ω is periodic, its box; its families are made
  /// @param nodes_name, bonds_name  of what is given, for messages: "file 'bonds.csv'"
  /// @throws InputError  a bond of a node with itself or given twice, a kernel point at 0, no node
  /// in Ω, a node in Ω without bonds, as geometry::PeriodicBox::take_in
  void set_families(WeightsInSpace &given, const std::vector<BondInSpace> &bonds,
                    const geometry::Cuboid &omega, const std::string &nodes_name,
                    const std::string &bonds_name);

  /// Nodes alone from a CSV file with the columns id, x, y, z and volume.
  /// @throws InputError  as read_weights_in_space
  WeightsInSpace read_nodes_in_space(const std::string &file);

  /// Nodes as by read_nodes_in_space, bonds from a CSV file with i, j (ids), weight [length^3] and,
  /// if they are there, qx, qy and qz: where the kernel is taken, relative to node i, else at node
  /// j. Bonds of nodes outside Ω are left out.
  /// @throws InputError  files that cannot be read, no column z, a volume <= 0, an id given twice
  /// or not known, a bond of a node with itself or given twice, a kernel point at 0, no node in Ω,
  /// a node in Ω without bonds; naming file, line and value
  WeightsInSpace read_weights_in_space(const std::string &nodes_file, const std::string &bonds_file,
                                       const geometry::Cuboid &omega, bool is_periodic);

  /// Cube root of the volume of Ω over the number of its nodes [length].
  double node_spacing(const WeightsInSpace &given, const geometry::Cuboid &omega);

  /// What is found of them. On a lattice of cubes they are held against every rule of the library.
  struct FindingsInSpace
  {
    double spacing = 0; ///< see node_spacing [length]
    std::size_t n_bonds = 0, n_negative = 0;
    std::size_t n_unpaired = 0;          ///< bonds between nodes in Ω without one back
    std::vector<std::size_t> n_crossing; ///< bonds across the sides of a periodic box, else empty
    /// Of the moments Σ w C_ab ξ^α from those of the ball, |α| = 1 and |α| <= 2, over the largest
    /// second moment times horizon^(|α| - 2).
    Worst first, second;
    double typical = 0;   ///< the median of the larger of the two
    double imbalance = 0; ///< largest |V_i w_ij C_ij - V_j w_ji C_ji| over the largest |V w C|
    std::vector<ElasticRange> elastic; ///< empty for scalar kernels
    std::string rule;                  ///< that nine in ten of the weights are; empty: none
    double rule_factor = 1;            ///< the weights are so many times the rule's
    std::vector<std::string> causes;   ///< what was done to all weights
    std::vector<std::string> outliers; ///< bonds that differ from the rule's, or are missing
  };

  /// @param meant  names of the rules that the weights are meant to be; empty: not known
  FindingsInSpace find_defects(const WeightsInSpace &given, const Kernel<3> &kernel,
                               const geometry::Cuboid &omega,
                               const std::vector<std::string> &meant);
} // namespace plumbline::meshfree
