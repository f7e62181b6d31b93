// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_PLUGIN_STAMP_H
#define ABUT_DEALII_PLUGIN_STAMP_H

/** @file
 * The stamp of whatever includes this header, plugin or program.
 */

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/registry.h>
#include <abut/dealii/rigid_obstacle.h>
#include <abut/plugin.h>

#include <deal.II/base/config.h>

/** @cond */
#define ABUT_STAMP_TEXT_OF(x) #x
#define ABUT_STAMP_TEXT(x) ABUT_STAMP_TEXT_OF(x)

#ifdef DEBUG
#define ABUT_STAMP_MODE "Debug"
#else
#define ABUT_STAMP_MODE "Release"
#endif

#if defined(OPEN_MPI)
#define ABUT_STAMP_MPI                                                         \
  "Open MPI " ABUT_STAMP_TEXT(OMPI_MAJOR_VERSION) "." ABUT_STAMP_TEXT(         \
      OMPI_MINOR_VERSION)
#elif defined(MPICH_VERSION)
#define ABUT_STAMP_MPI "MPICH " MPICH_VERSION
#elif defined(DEAL_II_WITH_MPI)
#define ABUT_STAMP_MPI                                                         \
  "MPI " ABUT_STAMP_TEXT(MPI_VERSION) "." ABUT_STAMP_TEXT(MPI_SUBVERSION)
#else
#define ABUT_STAMP_MPI "none"
#endif

#ifdef _LIBCPP_VERSION
#define ABUT_STAMP_LIBRARY ", libc++"
#elif defined(_GLIBCXX_USE_CXX11_ABI) && _GLIBCXX_USE_CXX11_ABI
#define ABUT_STAMP_LIBRARY ", libstdc++ C++11"
#else
#define ABUT_STAMP_LIBRARY ", libstdc++"
#endif

#ifdef _GLIBCXX_DEBUG
#define ABUT_STAMP_CHECKS ", _GLIBCXX_DEBUG"
#else
#define ABUT_STAMP_CHECKS ""
#endif
/** @endcond */

namespace abut
{
  /** A number that changes with any of the sizes. */
  constexpr std::uint64_t
  layout_of_sizes(const std::initializer_list<std::size_t> sizes)
  {
    std::uint64_t hash = 14695981039346656037u; // FNV-1a
    for (const std::size_t size : sizes)
      hash = (hash ^ size) * 1099511628211u;
    return hash;
  }

  /** Compiler and libraries of this translation unit. */
  constexpr abut_plugin_stamp plugin_stamp()
  {
    return {
        ABUT_PLUGIN_MAGIC,
        ABUT_PLUGIN_ABI,
        8 * sizeof(dealii::types::global_dof_index),
        ABUT_STAMP_MODE,
        DEAL_II_PACKAGE_VERSION,
        ABUT_STAMP_TEXT(DEAL_II_TRILINOS_VERSION_MAJOR) "." ABUT_STAMP_TEXT(
            DEAL_II_TRILINOS_VERSION_MINOR) "." ABUT_STAMP_TEXT(DEAL_II_TRILINOS_VERSION_SUBMINOR),
        ABUT_STAMP_MPI,
        "C++ ABI " ABUT_STAMP_TEXT(__GXX_ABI_VERSION)
            ABUT_STAMP_LIBRARY ABUT_STAMP_CHECKS,
        layout_of_sizes({sizeof(ContactPair<2>),
                         sizeof(ContactPair<3>),
                         sizeof(Obstacle<2>),
                         sizeof(PairCheck),
                         sizeof(PairResult<2>),
                         sizeof(PairResult<3>),
                         sizeof(Penetration<2>),
                         sizeof(Penetration<3>),
                         sizeof(MethodParameters),
                         sizeof(SolverParameters),
                         sizeof(SearchParameters),
                         sizeof(LinearReport),
                         sizeof(HeightObstacle<2>),
                         sizeof(RigidPose<2>),
                         sizeof(RigidPose<3>),
                         sizeof(ContactMeasures),
                         sizeof(ContactEffort),
                         sizeof(IterationReport),
                         sizeof(abut_progress),
                         sizeof(abut_obstacle_shape),
                         sizeof(abut_obstacle_surface),
                         sizeof(abut_surface_data),
                         sizeof(Registry<2>),
                         sizeof(la::Matrix),
                         sizeof(la::Vector),
                         sizeof(dealii::ParameterHandler),
                         sizeof(dealii::DoFHandler<2>),
                         sizeof(dealii::DoFHandler<3>),
                         sizeof(dealii::AffineConstraints<double>),
                         sizeof(dealii::DynamicSparsityPattern)})};
  }
} // namespace abut

#undef ABUT_STAMP_TEXT_OF
#undef ABUT_STAMP_TEXT
#undef ABUT_STAMP_MODE
#undef ABUT_STAMP_MPI
#undef ABUT_STAMP_LIBRARY
#undef ABUT_STAMP_CHECKS

#endif
