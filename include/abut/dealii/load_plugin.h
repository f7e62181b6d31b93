// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_LOAD_PLUGIN_H
#define ABUT_DEALII_LOAD_PLUGIN_H

/** @file
 * Abut at run time: a deal.II program compiled with these headers, but not
 * linked to Abut, loads the module libabut_plugin.so (in debug mode
 * libabut_plugin.g.so).
 */

#include <abut/dealii/plugin_stamp.h>
#include <abut/dealii/registry.h>

#include <deal.II/base/mpi.h>

#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace abut
{
  /** A plugin that cannot be used: the message names the file, what is wrong
   * and what to do, in one line. Thrown on all ranks. */
  class PluginError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** Parts of load_plugin(). The text that some of them return is the error; it
   * is empty without one. */
  namespace internal
  {
    /** Whether two stamps agree, and if not, in what. */
    inline std::string compare_stamps(const abut_plugin_stamp &plugin,
                                      const abut_plugin_stamp &program)
    {
      const auto differ = [](const std::string &what, const std::string &theirs,
                             const std::string &ours, const std::string &cure)
      {
        return theirs == ours
                   ? ""
                   : "it was built with " + what + theirs
                         + ", this program with " + what + ours + ": " + cure;
      };
      const auto text = [](const auto &field)
      { return std::string(field, strnlen(field, sizeof(field))); };
      const std::string together = "build both with the same ";
      const std::string problems[] = {
          differ("Abut's plugin ABI ", std::to_string(plugin.abi),
                 std::to_string(program.abi), together + "version of Abut"),
          differ("deal.II ", text(plugin.dealii), text(program.dealii),
                 together + "deal.II"),
          differ("deal.II in mode ", text(plugin.mode), text(program.mode),
                 std::string("take ")
                     + (text(program.mode) == "Debug" ? "libabut_plugin.g.so"
                                                      : "libabut_plugin.so")),
          differ("global numbers of bits ", std::to_string(plugin.index_bits),
                 std::to_string(program.index_bits), together + "deal.II"),
          differ("", text(plugin.mpi), text(program.mpi), together + "MPI"),
          differ("Trilinos ", text(plugin.trilinos), text(program.trilinos),
                 together + "Trilinos"),
          differ("", text(plugin.compiler), text(program.compiler),
                 together + "compiler and options"),
          differ("class layout ", std::to_string(plugin.layout),
                 std::to_string(program.layout),
                 together + "headers and options")};
      for (const std::string &problem : problems)
        if (!problem.empty())
          return problem;
      return "";
    }

    /** The folders in which dlopen() looks for a name without a slash:
     * LD_LIBRARY_PATH, those that the program was linked with, and the
     * system's. */
    inline std::vector<std::string> library_folders()
    {
      std::vector<std::string> result;
      void *const program = dlopen(nullptr, RTLD_LAZY);
      Dl_serinfo sizes;
      if (program == nullptr
          || dlinfo(program, RTLD_DI_SERINFOSIZE, &sizes) != 0)
        return result;
      std::vector<char> memory(sizes.dls_size);
      auto *const info = reinterpret_cast<Dl_serinfo *>(memory.data());
      if (dlinfo(program, RTLD_DI_SERINFOSIZE, info) == 0
          && dlinfo(program, RTLD_DI_SERINFO, info) == 0)
        for (unsigned int i = 0; i < info->dls_cnt; ++i)
          result.emplace_back(info->dls_serpath[i].dls_name);
      dlclose(program);
      return result;
    }

    /** The file that is meant by @p name: a name with a slash is a path, one
     * without is looked for as dlopen() does; a problem if it is nowhere. */
    inline std::string find_plugin(const std::string &name, std::string &path)
    {
      std::error_code error;
      path = name;
      if (name.find('/') != std::string::npos)
        return std::filesystem::is_regular_file(path, error)
                   ? ""
                   : "there is no such file"
                         + (name[0] == '/'
                                ? std::string()
                                : " in the working folder '"
                                      + std::filesystem::current_path(error)
                                            .string()
                                      + "'");
      std::string where;
      for (const std::string &folder : library_folders())
      {
        path = folder + "/" + name;
        if (std::filesystem::is_regular_file(path, error))
          return "";
        where += (where.empty() ? "" : ", ") + folder;
      }
      return "there is no such file in the library folders (" + where
             + "): give its full path, or add its folder to LD_LIBRARY_PATH";
    }

    /** Look at a file without running anything of it. */
    inline std::string check_plugin_file(const std::string &path)
    {
      std::ifstream file(path, std::ios::binary);
      if (!file)
        return "it cannot be read";
      const std::string content{std::istreambuf_iterator<char>(file),
                                std::istreambuf_iterator<char>()};
      Elf64_Ehdr elf;
      if (content.size() < sizeof(elf) || content.compare(0, 4, ELFMAG) != 0)
        return "it is not a shared library";
      // Its table of sections comes last. The system's loader would crash.
      std::memcpy(&elf, content.data(), sizeof(elf));
      if (content.size() < elf.e_shoff + elf.e_shnum * elf.e_shentsize)
        return "the end of the file is missing";
      const std::size_t place = content.find(ABUT_PLUGIN_MAGIC);
      abut_plugin_stamp stamp;
      if (place == std::string::npos || content.size() < place + sizeof(stamp))
        return "it is not a plugin of Abut: it has no stamp. The plugin is "
               "libabut_plugin.so or libabut_plugin.g.so";
      std::memcpy(&stamp, content.data() + place, sizeof(stamp));
      return compare_stamps(stamp, plugin_stamp());
    }

    /** Load a file that has been looked at. */
    inline std::string open_plugin(const std::string &path,
                                   const abut_plugin *&plugin)
    {
      // A plugin whose objects are still in use must not be unloaded.
      void *const handle = dlopen(std::filesystem::absolute(path).c_str(),
                                  RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
      if (handle == nullptr)
      {
        const char *const reason = dlerror();
        return std::string("it cannot be loaded: ")
               + (reason != nullptr ? reason : "unknown reason")
               + ". Is this program linked to deal.II as a shared library?";
      }
      const auto query = reinterpret_cast<abut_plugin_query_function>(
          dlsym(handle, ABUT_PLUGIN_QUERY));
      if (query == nullptr)
        return "it does not export the symbol " ABUT_PLUGIN_QUERY;
      plugin = query();
      if (plugin == nullptr || plugin->struct_size < sizeof(abut_plugin))
        return "its " ABUT_PLUGIN_QUERY " returns an empty result";
      return compare_stamps(*plugin->stamp, plugin_stamp());
    }

    /** Throw on all ranks if one has a problem. Collective. */
    inline void throw_plugin_error(const std::string &path,
                                   const std::string &problem,
                                   const MPI_Comm communicator)
    {
      namespace MPI = dealii::Utilities::MPI;
      const unsigned int none = MPI::n_mpi_processes(communicator);
      const unsigned int rank =
          MPI::min(problem.empty() ? none : MPI::this_mpi_process(communicator),
                   communicator);
      if (rank == none)
        return;
      throw PluginError(MPI::broadcast(
          communicator,
          "Cannot use '" + path + "' as a plugin: " + problem + ".", rank));
    }
  } // namespace internal

  /** Load the plugin @p name and add its methods to @p registry; throws
   * PluginError, and loads nothing, if it does not fit. A name with a slash is
   * a path, absolute or from the working folder; one without is looked for as
   * dlopen() does, in LD_LIBRARY_PATH, the folders that the program was linked
   * with, and the system's. It stays loaded until the program ends. Collective;
   * call it after MPI is initialised. */
  template <int dim>
  void load_plugin(const std::string &name, Registry<dim> &registry,
                   const MPI_Comm communicator = MPI_COMM_WORLD)
  {
    std::string path;
    std::string problem = internal::find_plugin(name, path);
    if (problem.empty())
      problem = internal::check_plugin_file(path);
    internal::throw_plugin_error(name, problem, communicator);
    const abut_plugin *plugin = nullptr;
    problem = internal::open_plugin(path, plugin);
    internal::throw_plugin_error(name, problem, communicator);
    (dim == 2 ? plugin->register_2d : plugin->register_3d)(&registry);
  }
} // namespace abut

#endif
