/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_PLUGIN_H
#define ABUT_PLUGIN_H

/** @file
 * Description of a plugin, and its one entry.
 *
 * A plugin is Abut as a module that deal.II programs load at run time, see
 * abut/dealii/load_plugin.h. It is not linked to deal.II: it uses that of the
 * program, and so both must come from the same compiler, with the same options
 * and the same deal.II. The stamp has its compiler and libraries. It stands as
 * plain data in the file, so that it is read and compared before the plugin is
 * loaded: no code of a plugin that does not fit is ever run. */

#include <abut/export.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** Raised when the C++ classes that cross the border change: virtual functions
 * of ContactAssembler, RigidObstacle and ContactLibrary, or their arguments. */
#define ABUT_PLUGIN_ABI 18

/** The first bytes of a stamp. */
#define ABUT_PLUGIN_MAGIC "abut-plugin\n\r\032"

/** Name of the function that a plugin exports, an abut_plugin_query_function.
 */
#define ABUT_PLUGIN_QUERY "abut_plugin_query"

  /** Compiler and libraries of a plugin; texts end in NUL. */
  typedef struct abut_plugin_stamp
  {
    char magic[16];      /**< ABUT_PLUGIN_MAGIC */
    uint32_t abi;        /**< ABUT_PLUGIN_ABI; decides whether the rest is read
                          */
    uint32_t index_bits; /**< of deal.II's global numbers: 32 or 64 */
    char mode[16];       /**< of deal.II's headers: "Debug" or "Release" */
    char dealii[24];     /**< version of deal.II */
    char trilinos[24];   /**< version of Trilinos */
    char mpi[32];        /**< name and version of MPI; "none" */
    char compiler[48];   /**< C++ ABI, standard library and its options */
    uint64_t layout;     /**< depends on the sizes of all classes that cross the
                              border */
  } abut_plugin_stamp;

  /** Functions of a plugin. */
  typedef struct abut_plugin
  {
    size_t struct_size;             /**< sizeof(abut_plugin) */
    const abut_plugin_stamp *stamp; /**< the same as in the file */
    /** Add the contact methods to @p registry, an abut::Registry<2>. A C++
     * function: it may throw. */
    void (*register_2d)(void *registry);
    /** The same for an abut::Registry<3>. */
    void (*register_3d)(void *registry);
  } abut_plugin;

  /** Type of abut_plugin_query(): returns what the plugin offers, constant. */
  typedef const abut_plugin *(*abut_plugin_query_function)(void);

#ifdef __cplusplus
}
#endif

#endif
