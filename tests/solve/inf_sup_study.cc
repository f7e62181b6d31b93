// SPDX-License-Identifier: LGPL-2.1-or-later
/* Inf-sup constants of the pairs of a scene `solid`, a line for each mesh:
 *
 *     inf_sup_study SCENE [SECTION/NAME=VALUE ...]
 *
 * doc/inf-sup.md has the definition, tests/app/check_inf_sup.py the scenes. */
#define create_solid_scene unused_solid_scene
#include "app/scenes/solid/solid_scene.cc"
#undef create_solid_scene

#include "app/scenes/loaded_scene.h"
#include "inf_sup.h"
#include "shim/contact_problem.h"

#include <iostream>

namespace abut
{
  struct StudyAccess
  {
    /** Of all points that the last detect() has made, in contact or not. */
    template <int dim>
    static double inf_sup(const ContactAssembler<dim> &contact,
                          const la::Matrix &stiffness)
    {
      const auto &i = *contact.implementation;
      return solve::inf_sup_constant(stiffness, i.rows.coefficients,
                                     i.input.solver, i.near_null_space())
          .constant;
    }
  };

  namespace app
  {
    namespace
    {
      template <int dim> class StudiedModel : public SolidModel<dim>
      {
      public:
        using SolidModel<dim>::SolidModel;

        void add_to_row(ContactResult &result,
                        std::map<std::string, double> &row) const override
        {
          SolidModel<dim>::add_to_row(result, row);
          const double constant = StudyAccess::inf_sup(
              this->MovingModel<dim>::run.contact, this->problem().stiffness);
          std::cout << constant << ' ' << result.rows << std::endl;
        }
      };

      template <int dim> class StudiedScene : public SolidScene<dim>
      {
        std::unique_ptr<ContactModel<dim>>
        create_model(ContactRunState<dim> &state) override
        {
          return std::make_unique<StudiedModel<dim>>(
              this->parameters, state, this->search, std::move(this->meshes));
        }
      };

      void study(const std::string &file,
                 const std::vector<std::string> &values)
      {
        LoadedScene loaded(ParameterFile(file, values));
        if (loaded.file.get("Dimension", "2") == "3")
          loaded.scene = std::make_unique<StudiedScene<3>>();
        else
          loaded.scene = std::make_unique<StudiedScene<2>>();
        loaded.scene->count(loaded.file);
        loaded.parse();
        RunOptions options;
        options.communicator = MPI_COMM_WORLD;
        options.scene_file = file;
        options.output_folder =
            std::filesystem::temp_directory_path() / "inf_sup_study";
        std::filesystem::create_directories(options.output_folder);
        Report report(MPI_COMM_WORLD, Verbosity::quiet);
        loaded.scene->run(options, report);
      }
    } // namespace
  }   // namespace app
} // namespace abut

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
  {
    abut::app::study(argv[1], {argv + 2, argv + argc});
  }
  catch (const std::exception &error)
  {
    std::cerr << error.what() << std::endl;
    return 1;
  }
  return 0;
}
