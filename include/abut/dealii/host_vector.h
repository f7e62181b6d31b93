// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_HOST_VECTOR_H
#define ABUT_DEALII_HOST_VECTOR_H

/** @file
 * Vectors of hosts, whatever their type: a function that takes a VectorView can
 * be given an la::Vector, which is used as it is, or any other vector of
 * deal.II with double values, which is copied: Vector, BlockVector,
 * LinearAlgebra::distributed::Vector, PETScWrappers::MPI::Vector and the block
 * vectors of Trilinos and PETSc. A type is only known in this header, on the
 * host's side; what Abut's library sees are pointers and IndexSets.
 */

#include <abut/dealii/linear_algebra.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::la
{
  /** @cond */
  namespace internal
  {
    template <typename V>
    using Owned = decltype(std::declval<const V &>().locally_owned_elements());
    template <typename V>
    using Block = decltype(std::declval<const V &>().block(0));

    template <typename V>
    constexpr bool is_host_vector =
        Has<Owned, V>::value && !std::is_same<V, Vector>::value;
    template <typename V> constexpr bool has_blocks = Has<Block, V>::value;
  } // namespace internal
  /** @endcond */

  /** A host's vector that is read. Refers to it, and is only made as an
   * argument. */
  class VectorView
  {
  public:
    /** No vector, where a function can do without one. */
    VectorView() = default;

    /** Abut's own type. */
    VectorView(const Vector &vector) : native_(&vector)
    {
    }

    /** Any other one. O(1), but for types without a pointer to their values. */
    template <typename V,
              typename = std::enable_if_t<internal::is_host_vector<V>>>
    VectorView(const V &vector)
        : is_given_(true),
          size_(vector.size()),
          owned_(vector.locally_owned_elements())
    {
      static_assert(std::is_same<typename V::value_type, double>::value,
                    "Abut takes vectors of double values, real ones.");
      append(vector);
    }

    VectorView(const VectorView &) = delete;
    VectorView &operator=(const VectorView &) = delete;

    /** Whether there is a vector. */
    explicit operator bool() const
    {
      return native_ != nullptr || is_given_;
    }

    /** The vector itself where it is of Abut's type, else null. */
    const Vector *native() const
    {
      return native_;
    }

    /** Number of entries on all ranks. */
    dealii::types::global_dof_index size() const
    {
      return native_ != nullptr ? native_->size() : size_;
    }

    /** Entries of this rank; not of a native() one. */
    const dealii::IndexSet &owned() const
    {
      return owned_;
    }

    /** Whether it can be read at unknowns of other ranks. */
    bool has_ghosts() const
    {
      return native_ != nullptr ? native_->has_ghost_elements() : has_ghosts_;
    }

    /** The same values as a vector of Abut's type with the entries @p owned,
     * which the view keeps: those of the host's vector come first, then zeros.
     * Not of a native() one. Collective. */
    Vector &copy(const dealii::IndexSet &owned,
                 const MPI_Comm communicator) const
    {
      copy_ = std::make_unique<Vector>(owned, communicator);
      double *target = data(*copy_);
      for (const Piece &piece : pieces_)
        target = std::copy_n(piece.begin, piece.n, target);
      return *copy_;
    }

  protected:
    /** Values of this rank that are next to each other. */
    struct Piece
    {
      const double *begin;        ///< first of them
      std::size_t n;              ///< their number
      std::vector<double> values; ///< where the host's cannot be pointed at
    };

    /** Note the pieces of a vector, block by block. */
    template <typename V> void append(const V &vector)
    {
      if constexpr (internal::has_blocks<V>)
        for (unsigned int b = 0; b < vector.n_blocks(); ++b)
          append(vector.block(b));
      else
      {
        Piece piece = {nullptr, 0, {}};
        has_ghosts_ = has_ghosts_ || vector.has_ghost_elements();
        if constexpr (std::is_same<V, Vector>::value)
          piece.begin = data(vector);
        else if constexpr (internal::Has<internal::Pointer, V>::value)
          piece.begin = vector.begin();
        const dealii::IndexSet owned = vector.locally_owned_elements();
        piece.n = owned.n_elements();
        if (piece.begin == nullptr && piece.n > 0)
        {
          piece.values.resize(piece.n);
          read(vector, owned, piece.values);
          piece.begin = piece.values.data();
        }
        pieces_.push_back(std::move(piece));
      }
    }

    /** Copy the entries @p owned of a vector that cannot be pointed at. */
    template <typename V>
    static void read(const V &vector, const dealii::IndexSet &owned,
                     std::vector<double> &values)
    {
      for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = vector(owned.nth_index_in_set(k));
    }

    const Vector *native_ = nullptr;           ///< null: of another type
    bool is_given_ = false;                    ///< one of another type
    dealii::types::global_dof_index size_ = 0; ///< of another type
    dealii::IndexSet owned_;                   ///< of another type
    bool has_ghosts_ = false;                  ///< of another type
    std::vector<Piece> pieces_;                ///< in the order of unknowns
    mutable std::unique_ptr<Vector> copy_;     ///< made by copy()
  };

  /** A host's vector that is written, too: as it is left when the view goes. */
  class MutableVectorView : public VectorView
  {
  public:
    /** Abut's own type. */
    MutableVectorView(Vector &vector) : VectorView(vector), target_(&vector)
    {
    }

    /** Any other one. */
    template <typename V,
              typename = std::enable_if_t<internal::is_host_vector<V>>>
    MutableVectorView(V &vector)
        : VectorView(static_cast<const V &>(vector)),
          store_([&vector](const double *values) { write(vector, values); })
    {
    }

    ~MutableVectorView()
    {
      if (copy_ != nullptr)
        store_(data(*copy_));
    }

    /** The vector itself where it is of Abut's type, else null. */
    Vector *native() const
    {
      return target_;
    }

    /** Take the values of @p from, all of them or the first ones. */
    void set(const Vector &from) const
    {
      if (target_ != nullptr)
        *target_ = from;
      else
        store_(data(from));
    }

  private:
    template <typename V> static void write(V &vector, const double *&values)
    {
      if constexpr (internal::has_blocks<V>)
        for (unsigned int b = 0; b < vector.n_blocks(); ++b)
          write(vector.block(b), values);
      else
      {
        const dealii::IndexSet owned = vector.locally_owned_elements();
        const std::size_t n = owned.n_elements();
        if constexpr (std::is_same<V, Vector>::value)
          std::copy_n(values, n, data(vector));
        else if constexpr (internal::Has<internal::Pointer, V>::value)
          std::copy_n(values, n, vector.begin());
        else
        {
          for (std::size_t k = 0; k < n; ++k)
            vector(owned.nth_index_in_set(k)) = values[k];
          vector.compress(dealii::VectorOperation::insert);
        }
        values += n;
      }
    }

    Vector *target_ = nullptr;
    std::function<void(const double *)> store_;
  };

  /** Copy a host's vector into one of Abut's with the same entries on each
   * rank, or more: the rest is 0. Collective. */
  template <typename V,
            typename = std::enable_if_t<internal::is_host_vector<V>>>
  void copy(const V &from, Vector &to)
  {
    to = VectorView(from).copy(to.locally_owned_elements(),
                               to.get_mpi_communicator());
  }

  /** Copy a vector of Abut's, as ContactResults::pressure() returns it, into
   * one of a host's with the same entries on each rank, or the first of them.
   */
  inline void copy(const Vector &from, const MutableVectorView &to)
  {
    to.set(from);
  }
} // namespace abut::la

#endif
