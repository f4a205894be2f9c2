#pragma once

#include "meshfree/check/bond_file.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// Adds the images of all nodes that lie in the mesh, which covers their periodic box and its
  /// collar. Images have the id, volume and line of their node.
  /// @pre  nodes.box is there, and has taken the nodes in
  void add_images(const geometry::Mesh &mesh, GivenNodes<2> &nodes);

  /// The same in space: images within a layer around the box.
  /// @param width  of the layer [length]
  void add_images(double width, GivenNodes<3> &nodes);

  /// The images to which the bonds of a periodic box lead.
  template <int dim>
  class NearestImages
  {
  public:
    NearestImages(const GivenNodes<dim> &nodes, const geometry::NodeCells<dim> &cells);

    /// Of the node of cell j and its images, the one nearest to the node of cell i.
    unsigned int nearest(unsigned int j, unsigned int i) const;

  private:
    const geometry::NodeCells<dim> &cells_;
    std::vector<std::vector<unsigned int>> images_; ///< of each node, itself among them
  };

  /// Bonds to images as bonds to the nodes themselves; neighbours in ascending order.
  template <int dim>
  std::vector<Family<dim>> without_images(const std::vector<Family<dim>> &families,
                                          const GivenNodes<dim> &nodes,
                                          const geometry::NodeCells<dim> &cells);

  /// The number of bonds that cross each pair of opposite sides of the box.
  template <int dim>
  std::vector<std::size_t> crossing_bonds(const std::vector<Family<dim>> &families,
                                          const GivenNodes<dim> &nodes,
                                          const geometry::NodeCells<dim> &cells);

  /// What is wrong where no bond crosses some of the sides.
  /// @param n_crossing  bonds, in x, y and z
  /// @return  empty: bonds cross all of them
  std::string missing_crossings(const std::vector<std::size_t> &n_crossing);
} // namespace plumbline::meshfree
