// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_REGISTRY_H
#define ABUT_DEALII_REGISTRY_H

/** @file
 * Contact methods by name. A program that links Abut fills its registry by
 * register_all(), one that loads Abut at run time by load_plugin(); the rest is
 * the same:
 *
 *     abut::Registry<dim> registry;
 *     abut::load_plugin("libabut_plugin.so", registry);
 *     registry.declare_parameters(prm);
 *     prm.parse_input("contact.prm");
 *     auto contact = registry.create(prm, MPI_COMM_WORLD);
 */

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/nearest_word.h>
#include <abut/dealii/rigid_obstacle.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace abut
{
  /** Entries of Abut in a registry. No function is collective, except that
   * assemblers must be created on all ranks of their communicator. */
  template <int dim> class ContactLibrary
  {
  public:
    virtual ~ContactLibrary() = default;

    /** The words of the parameter `Method/Enforcement`. */
    virtual std::vector<std::string> methods() const = 0;

    /** ContactAssembler::declare_parameters(). */
    virtual void declare_parameters(dealii::ParameterHandler &prm) const = 0;

    /** An assembler with default parameters. */
    virtual std::unique_ptr<ContactAssembler<dim>>
    create(MPI_Comm communicator) const = 0;

    /** Constructor of RigidObstacle: a shape. */
    virtual std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const abut_obstacle_shape &shape) const = 0;

    /** Another: a height. */
    virtual std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const HeightObstacle<dim> &height) const = 0;

    /** Another: a function. */
    virtual std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(std::shared_ptr<dealii::Function<dim>> value,
                  bool hollow) const = 0;

    /** Another: a surface of facets. */
    virtual std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const abut_surface_data &surface,
                  const abut_obstacle_surface &options) const = 0;
  };

  /** A name that is not registered, or is registered twice. */
  class RegistryError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** The contact methods of a program; owned by the program. Nothing is
   * registered by itself. Objects that it has made may outlive it. */
  template <int dim> class Registry
  {
  public:
    /** Take all methods of a library. Throws RegistryError, and takes none, if
     * a name is there already. Not collective. */
    void add(std::shared_ptr<const ContactLibrary<dim>> library)
    {
      const std::vector<std::string> present = methods();
      for (const std::string &name : library->methods())
        if (std::find(present.begin(), present.end(), name) != present.end())
          throw RegistryError("The contact method '" + name
                              + "' is registered already.");
      libraries_.push_back(std::move(library));
    }

    /** Names of all methods. Not collective. */
    std::vector<std::string> methods() const
    {
      std::vector<std::string> names;
      for (const auto &library : libraries_)
        for (const std::string &name : library->methods())
          names.push_back(name);
      return names;
    }

    /** Declare the parameters of all methods: sections `Method`, `Solver` and
     * `Search`. Not collective. */
    void declare_parameters(dealii::ParameterHandler &prm) const
    {
      for (const auto &library : libraries_)
        library->declare_parameters(prm);
    }

    /** An assembler for the method that `Method/Enforcement` names, with all
     * parameters read. Collective over @p communicator, which must be that of
     * the triangulation. */
    std::unique_ptr<ContactAssembler<dim>>
    create(dealii::ParameterHandler &prm, const MPI_Comm communicator) const
    {
      prm.enter_subsection("Method");
      const std::string name = prm.get("Enforcement");
      prm.leave_subsection();
      auto contact = find(name).create(communicator);
      contact->parse_parameters(prm);
      return contact;
    }

    /** An assembler for a method by its name, with default parameters.
     * Collective. */
    std::unique_ptr<ContactAssembler<dim>>
    create(const std::string &name, const MPI_Comm communicator) const
    {
      dealii::ParameterHandler prm;
      find(name).declare_parameters(prm);
      prm.enter_subsection("Method");
      prm.set("Enforcement", name);
      prm.leave_subsection();
      return create(prm, communicator);
    }

    /** A rigid obstacle; takes what a constructor of RigidObstacle takes. Not
     * collective. */
    std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const abut_obstacle_shape &shape) const
    {
      return first().make_obstacle(shape);
    }

    /** The same. */
    std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const HeightObstacle<dim> &height) const
    {
      return first().make_obstacle(height);
    }

    /** The same. */
    std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(std::shared_ptr<dealii::Function<dim>> value,
                  const bool hollow = false) const
    {
      return first().make_obstacle(std::move(value), hollow);
    }

    /** The same. */
    std::shared_ptr<RigidObstacle<dim>>
    make_obstacle(const abut_surface_data &surface,
                  const abut_obstacle_surface &options) const
    {
      return first().make_obstacle(surface, options);
    }

  private:
    const ContactLibrary<dim> &first() const
    {
      if (libraries_.empty())
        throw RegistryError("The registry is empty: call register_all() or "
                            "load_plugin() first.");
      return *libraries_.front();
    }

    const ContactLibrary<dim> &find(const std::string &name) const
    {
      first();
      std::string all;
      std::vector<std::string> names;
      for (const auto &library : libraries_)
        for (const std::string &known : library->methods())
        {
          if (known == name)
            return *library;
          all += (all.empty() ? "" : ", ") + known;
          names.push_back(known);
        }
      throw RegistryError("There is no contact method '" + name
                          + "'. There are: " + all + "."
                          + did_you_mean(name, names));
    }

    std::vector<std::shared_ptr<const ContactLibrary<dim>>> libraries_;
  };

  /** Register all methods of the Abut that the program is linked to. Throws
   * RegistryError if they are there already. Not collective. */
  template <int dim> void register_all(Registry<dim> &registry);
} // namespace abut

#endif
