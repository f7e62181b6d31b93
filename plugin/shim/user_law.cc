// SPDX-License-Identifier: LGPL-2.1-or-later
#include "user_law.h"

#include <abut/user_law.h>

#include <deal.II/base/exceptions.h>

#include <dlfcn.h>
#include <filesystem>

namespace abut::shim
{
  namespace
  {
    /** Words in which the two kinds of tables differ. */
    struct Kind
    {
      const char *query, *exported, *file, *parameters;
    };
    const Kind normal = {ABUT_USER_LAW_QUERY, "ABUT_USER_LAW",
                         "Method/Law file", "Method/Law parameters"};
    const Kind tangential = {ABUT_USER_FRICTION_QUERY, "ABUT_USER_FRICTION",
                             "Method/Friction file",
                             "Method/Friction parameters"};

    /** The table that the shared object exports by a function of type Query;
     * throws a text if it cannot be had. */
    template <typename Query>
    auto &open(const std::string &file, const Kind &kind)
    {
      std::error_code error;
      if (!std::filesystem::is_regular_file(file, error))
        throw std::string("there is no such file");
      // Its functions are used as long as there are objects with the law.
      void *const handle = dlopen(std::filesystem::absolute(file).c_str(),
                                  RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
      if (handle == nullptr)
      {
        const char *const reason = dlerror();
        throw "it cannot be loaded: "
            + std::string(reason != nullptr ? reason : "unknown reason");
      }
      const auto query = reinterpret_cast<Query>(dlsym(handle, kind.query));
      if (query == nullptr)
        throw "it exports no symbol " + std::string(kind.query) + ": write "
            + kind.exported + "(law, names, check) at the end of its source";
      const auto *const found = query();
      if (found == nullptr)
        throw std::string(kind.query) + "() returned NULL";
      return *found;
    }

    /** A structure: its name, and its sizes there and here. */
    using Size = std::pair<const char *, std::pair<std::size_t, std::size_t>>;

    /** The shared object may be of another version. */
    void check_version(const std::uint32_t abi, const std::vector<Size> &sizes)
    {
      if (abi != ABUT_USER_LAW_ABI)
        throw "it was compiled for ABI " + std::to_string(abi)
            + " of user laws, this is ABI " + std::to_string(ABUT_USER_LAW_ABI)
            + ": compile it with the headers of this version";
      for (const auto &[name, size] : sizes)
        if (size.first != size.second)
          throw "its " + std::string(name) + " has "
              + std::to_string(size.first) + " bytes, that of this version "
              + std::to_string(size.second)
              + ": compile it with the headers of this version";
    }

    void check_table(const abut_law *const law)
    {
      if (law == nullptr || law->struct_size != sizeof(abut_law)
          || law->name == nullptr || law->classify == nullptr
          || law->linearise == nullptr)
        throw std::string("its abut_law is not complete: struct_size, name, "
                          "classify and linearise must be set");
      if (abut_law_find(law->name) != nullptr)
        throw "its law has the name of a built-in one, '"
            + std::string(law->name) + "': give it another";
      if (law->outer != ABUT_OUTER_NONE
          || (law->flags & ~std::uint32_t(ABUT_LAW_HARD)) != 0)
        throw std::string("its law must have outer = ABUT_OUTER_NONE and no "
                          "flag but ABUT_LAW_HARD");
    }

    void check_table(const abut_friction *const law)
    {
      if (law == nullptr || law->struct_size != sizeof(abut_friction)
          || law->name == nullptr || law->bound == nullptr)
        throw std::string("its abut_friction is not complete: struct_size, "
                          "name and bound must be set");
      if (abut_friction_find(law->name) != nullptr)
        throw "its law has the name of a built-in one, '"
            + std::string(law->name) + "': give it another";
    }

    /** Values in the order of the names. */
    std::vector<double> order(const char *const *names,
                              const std::map<std::string, double> &given)
    {
      std::vector<double> values;
      std::string all;
      std::map<std::string, double> left = given;
      for (; names != nullptr && *names != nullptr; ++names)
      {
        const auto place = left.find(*names);
        if (place == left.end())
          throw "the law's parameter '" + std::string(*names) + "' is missing";
        values.push_back(place->second);
        left.erase(place);
        all += (all.empty() ? "" : ", ") + std::string(*names);
      }
      if (!left.empty())
        throw "the law has no parameter '" + left.begin()->first
            + "'; it has: " + (all.empty() ? "none" : all);
      return values;
    }

    /** The law of a shared object with its parameters in order; @p sizes are
     * those of the structures of what it exports. */
    template <typename Law, typename Query, typename Sizes>
    std::shared_ptr<const Law> load(const Kind &kind, const std::string &file,
                                    const std::map<std::string, double> &given,
                                    const Sizes &sizes)
    {
      std::string where = kind.file + (": " + file);
      try
      {
        if (file.empty())
          throw std::string("the name is empty: Method/Enforcement = user "
                            "needs the shared object of your law");
        const auto &user = open<Query>(file, kind);
        check_version(user.abi, sizes(user));
        check_table(user.law);
        where = kind.parameters;
        const Law result = {*user.law, order(user.parameter_names, given)};
        const char *const complaint = user.check != nullptr
                                          ? user.check(result.parameters.data())
                                          : nullptr;
        if (complaint != nullptr)
          throw std::string(complaint);
        return std::make_shared<Law>(result);
      }
      catch (const std::string &problem)
      {
        throw dealii::ExcMessage(where + ": " + problem + ".");
      }
    }
  } // namespace

  std::shared_ptr<const UserLaw>
  load_user_law(const std::string &file,
                const std::map<std::string, double> &parameters)
  {
    return load<UserLaw, abut_user_law_query_function>(
        normal, file, parameters,
        [](const abut_user_law &user)
        {
          return std::vector<Size>{
              {"abut_user_law", {user.struct_size, sizeof(abut_user_law)}},
              {"abut_law", {user.law_size, sizeof(abut_law)}},
              {"abut_law_points", {user.points_size, sizeof(abut_law_points)}},
              {"abut_law_linearisation",
               {user.linearisation_size, sizeof(abut_law_linearisation)}}};
        });
  }

  std::shared_ptr<const UserFriction>
  load_user_friction(const std::string &file,
                     const std::map<std::string, double> &parameters)
  {
    return load<UserFriction, abut_user_friction_query_function>(
        tangential, file, parameters,
        [](const abut_user_friction &user)
        {
          return std::vector<Size>{
              {"abut_user_friction",
               {user.struct_size, sizeof(abut_user_friction)}},
              {"abut_friction", {user.friction_size, sizeof(abut_friction)}},
              {"abut_friction_bounds",
               {user.bounds_size, sizeof(abut_friction_bounds)}}};
        });
  }
} // namespace abut::shim
