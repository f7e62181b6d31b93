// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_SURFACE_EXCHANGE_H
#define ABUT_SHIM_SURFACE_EXCHANGE_H

#include "by_element.h"
#include "contact_surface.h"
#include "handles.h"
#include "point_to_point.h"
#include "self_contact.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/parts.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <set>
#include <unordered_map>

namespace abut::shim
{
  /** Makes boundary facets of other ranks known where rows need them, point to
   * point. No rank gets the whole interface.
   *
   * A rank has the facets of its cells. It learns
   *
   *   the facets around the nodes that it owns, because each facet is announced
   *   to the owners of its nodes and of the nodes that those hang on;
   *   two rings of facets around these, from the owners of their nodes:
   *   averaged normals and dropped neighbours are then those of the whole
   *   surface;
   *   the facets of the other side that are near these: all ranks gather boxes
   *   around their parts, and each sends what the core finds near them
   *   (abut/parts.h); with a ring around them.
   *
   * A rank has the data of a node from the node's owner. Numbers of facets run
   * along the mesh, and so do those of nodes. */
  template <int dim> class SurfaceExchange
  {
  public:
    using Index = dealii::types::global_dof_index;

    /** Two surfaces that may touch; the primary is empty for obstacles. */
    struct Link
    {
      std::string name;
      std::set<dealii::types::boundary_id> secondary, primary;
      /** Distance within which facets are looked for; with @ref margin added,
       * by which nodes may have moved without anything being missed. */
      double reach = 0., margin = 0.;
      /** Its sides are searched in the configuration of gather(), not in the
       * reference configuration. */
      bool displaced = false;
    };

    /** Nodes may also have moved by this part of the size of the smallest
     * facet. */
    static constexpr double relative_margin = 0.25;

    /** Find the facets with these boundary ids and the rings around them. All
     * references must outlive this object, and cell_refusal() and
     * displacement_refusal() must have found nothing. A pass over the cells.
     * Collective. */
    SurfaceExchange(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const std::set<dealii::types::boundary_id> &boundary_ids,
                    SelfContact<dim> self_contact);

    const std::set<dealii::types::boundary_id> &boundary_ids() const
    {
      return boundary_ids_;
    }

    /** Kinds that facets of the mesh may have. */
    std::set<abut_facet_kind> kinds() const;

    /** Whether a facet with these boundary ids on any rank is a triangle of
     * degree 2. Collective. */
    bool has_quadratic_triangles(
        const std::set<dealii::types::boundary_id> &ids) const;

    /** Which facets are on the primary side of their own surface. */
    const SelfContact<dim> &self_contact() const
    {
      return self_contact_;
    }

    /** Split surfaces that touch themselves again, see SelfContact::renew().
     * If sides change, facets have other ids, and the next gather() searches
     * again for what is near. Returns whether they do. Collective. */
    bool renew_sides(const la::Vector &displacement, double near,
                     abut_context *context);

    /** Take sides from a checkpoint, see SelfContact::load(); otherwise as
     * renew_sides(). */
    bool load_sides(std::istream &stream);

    /** Hanging nodes alone. */
    const dealii::AffineConstraints<double> &hanging() const
    {
      return hanging_;
    }

    /** The constraints have changed: the next gather() exchanges the data of
     * nodes again, but not facets. */
    void refresh();

    /** The facets that this rank needs, with those near each other of each
     * link, where the bodies were in the last gather_at(). Distances in @p
     * links are raised to those of the call before, if those are larger; then
     * no facet is sent. Throws ContactError on all ranks for facets without
     * area. Collective. */
    ContactSurface<dim> gather(abut_context *context, std::vector<Link> &links,
                               const abut_search_options &search);

    /** The same where bodies are displaced by @p place (owned). Facets that are
     * not near any more are forgotten, and so are their nodes but for those
     * with a first unknown in @p kept. Collective. */
    ContactSurface<dim> gather_at(const la::Vector &place,
                                  const std::set<Index> &kept,
                                  abut_context *context,
                                  std::vector<Link> &links,
                                  const abut_search_options &search);

    /** Displacement of the bodies in the last gather_at(); empty: 0. */
    const la::Vector &place() const
    {
      return place_;
    }

    /** A length that the least distance of the two sides of a link does not
     * exceed, from the boxes of the last gather(). Collective. */
    double distance_bound(std::size_t link) const;

    /** Bring prescribed values up to those that the host's constraints have
     * now. Nothing is sent unless one has changed. Returns whether one has.
     * Collective. */
    bool update_constants(ContactSurface<dim> &surface);

    /** The displacement that was committed of each node of the gathered
     * surface:
     * @p u as it is (owned; empty: 0), constraints and all, whatever they
     * prescribe by now. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    displacements_as_given(const ContactSurface<dim> &surface,
                           const la::Vector &u);

    /** Displacement of each node of the gathered surface, from the owned
     * unknowns: what constraints make of it. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    displacements(const ContactSurface<dim> &surface, const la::Vector &u);

    /** Make marks that any rank has set known to all that have the node;
     * @p marks [any number of blocks][nodes of the surface]. Collective. */
    void merge_marks(const ContactSurface<dim> &surface,
                     std::vector<std::uint8_t> &marks);

    /** Data that this rank has sent. */
    CommunicationReport communication() const;

  private:
    using Facet = typename ContactSurface<dim>::Facet;
    using Node = typename ContactSurface<dim>::Node;
    using Parent = typename ContactSurface<dim>::Parent;
    using Term = solve::NodeMap::Term;

    /** A facet with its nodes, and the nodes that these hang on, named by their
     * first unknown. */
    struct FacetRecord
    {
      Facet facet;
      std::vector<Index> nodes, parents;
      /** How far from own nodes: 1 around them, 3 the second ring around
       * these; near or beyond: of the other side. */
      int ring = beyond;
    };
    static constexpr int near = 4, beyond = 5;

    /** An unknown by constraints: a sum of terms and a constant. */
    struct Line
    {
      std::vector<Term> terms;
      double constant = 0.;
    };

    /** Data of a node from its owner. */
    struct NodeRecord
    {
      Node node;
      std::array<Line, dim> lines;
      std::vector<Parent> parents;
    };

    /** An owner's data of a node's place in the surfaces. */
    struct Place
    {
      std::vector<std::int64_t> facets; ///< that depend on it
      std::int64_t number = -1;
    };

    /** Let facets have the ids of their sides. */
    void assign_sides();
    void collect();
    void number_own();
    void announce();
    void describe();
    NodeRecord describe_node(const dealii::Point<dim> &point,
                             const std::array<Index, dim> &dof) const;
    void add_ring(int from, int to);
    void fetch_nodes();
    void write(const FacetRecord &record, Parcel &parcel) const;
    FacetRecord read_facet(Parcel &parcel) const;
    void write(const NodeRecord &record, Parcel &parcel) const;
    NodeRecord read_node(Parcel &parcel) const;
    void add_facet(const FacetRecord &record, int ring);

    /** [2 * links: secondary, primary][ranks] boxes around the facets of a
     * rank. */
    using Boxes = std::vector<std::vector<std::vector<abut_box>>>;

    /** Facets of a side of a link, as the core wants them. */
    struct Part
    {
      std::vector<std::int64_t> number;
      Handle<abut_surface> surface;
    };
    template <typename Predicate>
    Part make_part(abut_context *context,
                   const std::set<dealii::types::boundary_id> &ids,
                   bool displaced, const Predicate &belongs) const;
    /** Find where nodes that are known here are displaced to. Collective. */
    void displace();
    /** Forget nodes of no facet. */
    void forget_nodes(const std::set<Index> &kept);
    std::vector<double> own_boxes(abut_context *context,
                                  const std::vector<Link> &links) const;
    void gather_boxes(abut_context *context, const std::vector<Link> &links);
    std::map<unsigned int, std::set<std::int64_t>>
    select(abut_context *context, std::size_t side, const Link &link,
           const abut_search_options &search) const;
    bool is_known(std::vector<Link> &links,
                  const abut_search_options &search) const;
    void find_near(abut_context *context, const std::vector<Link> &links,
                   const abut_search_options &search);
    ContactSurface<dim> arrange() const;
    void share_values(const ContactSurface<dim> &surface);

    const dealii::Mapping<dim> &mapping_;
    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const std::set<dealii::types::boundary_id> boundary_ids_;
    SelfContact<dim> self_contact_;
    const dealii::AffineConstraints<double> hanging_;
    PointToPoint post_;
    const Owners owners_;
    /** The facets of the cells of an element. */
    struct CellFacets
    {
      abut_facet_kind kind;
      /** [faces of a cell][nodes of a facet][component] unknown of the cell. */
      std::vector<std::vector<std::array<unsigned int, dim>>> dof;
    };
    static CellFacets facets_of(const dealii::FiniteElement<dim> &fe);
    const ByElement<CellFacets> cell_facets_;

    std::vector<FacetRecord> own_; ///< in the order of their numbers
    std::int64_t n_facets_everywhere_ = 0;
    /** As the owner of nodes. */
    std::unordered_map<Index, Place> places_;
    std::unordered_map<std::int64_t, FacetRecord> announced_;
    std::unordered_map<Index, NodeRecord> described_;
    /** Data known here. */
    std::unordered_map<std::int64_t, FacetRecord> facets_;
    std::unordered_map<Index, NodeRecord> nodes_;
    la::Vector place_; ///< empty: 0
    /** By the first unknown of nodes; not there: 0. */
    std::unordered_map<Index, dealii::Tensor<1, dim>> displaced_;
    /** Data of the last selection. */
    std::vector<Link> links_;
    abut_search_options search_;
    Boxes boxes_;
    SharedValues unknowns_, marks_;
  };
} // namespace abut::shim

#endif
