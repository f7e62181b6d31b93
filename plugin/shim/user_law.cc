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
    /** What the shared object exports; throws a text if it cannot be had. */
    const abut_user_law &open(const std::string &file)
    {
      if (file.empty())
        throw std::string("the name is empty: Method/Enforcement = user needs "
                          "the shared object of your law");
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
      const auto query = reinterpret_cast<abut_user_law_query_function>(
          dlsym(handle, ABUT_USER_LAW_QUERY));
      if (query == nullptr)
        throw std::string("it exports no symbol " ABUT_USER_LAW_QUERY
                          ": write ABUT_USER_LAW(law, names, check) at the end "
                          "of its source");
      const abut_user_law *const found = query();
      if (found == nullptr)
        throw std::string(ABUT_USER_LAW_QUERY "() returned NULL");
      return *found;
    }

    /** The shared object may be of another version. */
    void check_version(const abut_user_law &user)
    {
      if (user.abi != ABUT_USER_LAW_ABI)
        throw "it was compiled for ABI " + std::to_string(user.abi)
            + " of user laws, this is ABI " + std::to_string(ABUT_USER_LAW_ABI)
            + ": compile it with the headers of this version";
      const std::pair<const char *, std::pair<std::size_t, std::size_t>>
          sizes[] = {
              {"abut_user_law", {user.struct_size, sizeof(abut_user_law)}},
              {"abut_law", {user.law_size, sizeof(abut_law)}},
              {"abut_law_points", {user.points_size, sizeof(abut_law_points)}},
              {"abut_law_linearisation",
               {user.linearisation_size, sizeof(abut_law_linearisation)}}};
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
          throw "Method/Law parameters does not give its parameter '"
              + std::string(*names) + "'";
        values.push_back(place->second);
        left.erase(place);
        all += (all.empty() ? "" : ", ") + std::string(*names);
      }
      if (!left.empty())
        throw "Method/Law parameters gives '" + left.begin()->first
            + "', but its parameters are: " + (all.empty() ? "none" : all);
      return values;
    }
  } // namespace

  std::shared_ptr<const UserLaw>
  load_user_law(const std::string &file,
                const std::map<std::string, double> &parameters)
  {
    try
    {
      const abut_user_law &user = open(file);
      check_version(user);
      check_table(user.law);
      const UserLaw result = {*user.law,
                              order(user.parameter_names, parameters)};
      const char *const complaint = user.check != nullptr
                                        ? user.check(result.parameters.data())
                                        : nullptr;
      if (complaint != nullptr)
        throw std::string(complaint);
      return std::make_shared<UserLaw>(result);
    }
    catch (const std::string &problem)
    {
      throw dealii::ExcMessage("Method/Law file = " + file + ": " + problem
                               + ".");
    }
  }
} // namespace abut::shim
