// SPDX-License-Identifier: LGPL-2.1-or-later
/* A program linked to an installed Abut, which loads the installed plugin as
 * well: both offer the same methods, and each works beside the other. */
#include <abut/dealii/registry.h>
#include <abut/version.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <string>

void load(const std::string &path, abut::Registry<2> &registry);

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  abut::Registry<2> linked, loaded;
  abut::register_all(linked);
  load(ABUT_PLUGIN_PATH, loaded);
  for (const abut::Registry<2> *registry : {&linked, &loaded})
  {
    const auto contact = registry->create("penalty", MPI_COMM_WORLD);
    if (contact->iteration().reason != ABUT_REASON_NONE)
      return 1;
  }
  try
  {
    abut::register_all(linked);
    return 1;
  }
  catch (const abut::RegistryError &error)
  {
    std::cout << error.what() << std::endl;
  }
  try
  {
    linked.create("penality", MPI_COMM_WORLD);
    return 1;
  }
  catch (const abut::RegistryError &error)
  {
    if (std::string(error.what()).find("mean 'penalty'?") == std::string::npos)
      return 1;
  }
  std::cout << ABUT_VERSION << " "
            << (linked.methods() == loaded.methods() ? "same" : "other")
            << " methods: " << linked.methods().size() << std::endl;
  return 0;
}
