/* SPDX-License-Identifier: LGPL-2.1-or-later
 * The obstacle problem of deal.II's step-41 by PETSc: bilinear elements on a
 * structured grid, SNESVI, grid sequencing. Shares no code with Abut and knows
 * nothing of it; snesvi_speed.py builds and runs both.
 *
 *     -Laplace u >= -10, u >= stairs on (-1,1)^2, u = 0 on the boundary
 *
 *     snesvi -coarsest 3 -snes_grid_sequence 6 [PETSc's options]
 *
 * starts on level 3, 8 x 8 cells, and ends on level 9. Prints a line of JSON:
 * unknowns, nodes in contact, energy, contact force, steps on the last grid,
 * and seconds of the processor from the first grid to the last answer.
 */
#include <petscdmda.h>
#include <petscsnes.h>
#include <petsctime.h>
#include <sys/resource.h>

static const double load = -10.;

static double
stairs(double x)
{
  return x < -.5 ? -.2 : x < 0. ? -.4 : x < .5 ? -.6 : -.8;
}

static double
processor_seconds(void)
{
  struct rusage used;
  getrusage(RUSAGE_SELF, &used);
  return (double)used.ru_utime.tv_sec + 1e-6 * (double)used.ru_utime.tv_usec
         + (double)used.ru_stime.tv_sec + 1e-6 * (double)used.ru_stime.tv_usec;
}

static int
is_border(const DMDALocalInfo *grid, int i, int j)
{
  return i == 0 || j == 0 || i == grid->mx - 1 || j == grid->my - 1;
}

/* Three times the stiffness of a node, without neighbours on the border. */
static double
times_stiffness(const DMDALocalInfo *grid, double **u, int i, int j)
{
  double sum = 8. * u[j][i];
  for (int l = -1; l <= 1; ++l)
    for (int k = -1; k <= 1; ++k)
      if ((k || l) && !is_border(grid, i + k, j + l))
        sum -= u[j + l][i + k];
  return sum / 3.;
}

/* K u - f; u on the border. */
static PetscErrorCode
residual(DMDALocalInfo *grid, void *values, void *result, void *context)
{
  double **u = (double **)values, **r = (double **)result;
  const double h = 2. / (grid->mx - 1);
  (void)context;
  for (int j = grid->ys; j < grid->ys + grid->ym; ++j)
    for (int i = grid->xs; i < grid->xs + grid->xm; ++i)
      r[j][i] = is_border(grid, i, j)
                    ? u[j][i]
                    : times_stiffness(grid, u, i, j) - load * h * h;
  return 0;
}

static PetscErrorCode
jacobian(DMDALocalInfo *grid, void *values, Mat matrix, Mat preconditioner,
         void *context)
{
  (void)values;
  (void)matrix;
  (void)context;
  for (int j = grid->ys; j < grid->ys + grid->ym; ++j)
    for (int i = grid->xs; i < grid->xs + grid->xm; ++i)
    {
      const MatStencil row = {.i = i, .j = j};
      MatStencil column[9];
      double entry[9];
      int n = 0;
      for (int l = -1; l <= 1; ++l)
        for (int k = -1; k <= 1; ++k)
        {
          if ((k || l)
              && (is_border(grid, i, j) || is_border(grid, i + k, j + l)))
            continue;
          column[n] = (MatStencil){.i = i + k, .j = j + l};
          entry[n++] = k || l ? -1. / 3. : is_border(grid, i, j) ? 1. : 8. / 3.;
        }
      PetscCall(MatSetValuesStencil(preconditioner, 1, &row, n, column, entry,
                                    INSERT_VALUES));
    }
  PetscCall(MatAssemblyBegin(preconditioner, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(preconditioner, MAT_FINAL_ASSEMBLY));
  PetscCall(MatSetOption(preconditioner, MAT_SYMMETRIC, PETSC_TRUE));
  return 0;
}

static PetscErrorCode
bounds(SNES snes, Vec lower, Vec upper)
{
  DM dm;
  DMDALocalInfo grid;
  double **psi;
  PetscCall(SNESGetDM(snes, &dm));
  PetscCall(DMDAGetLocalInfo(dm, &grid));
  PetscCall(VecSet(upper, PETSC_INFINITY));
  PetscCall(DMDAVecGetArray(dm, lower, &psi));
  for (int j = grid.ys; j < grid.ys + grid.ym; ++j)
    for (int i = grid.xs; i < grid.xs + grid.xm; ++i)
      psi[j][i] = is_border(&grid, i, j) ? -PETSC_INFINITY
                                         : stairs(-1. + 2. * i / (grid.mx - 1));
  PetscCall(DMDAVecRestoreArray(dm, lower, &psi));
  return 0;
}

/* Nodes in contact, force and energy of the answer. */
static PetscErrorCode
report(SNES snes, double seconds)
{
  DM dm;
  DMDALocalInfo grid;
  Vec solution, local;
  double **u, force = 0., energy = 0.;
  int n_active = 0, steps;
  PetscCall(SNESGetDM(snes, &dm));
  PetscCall(DMDAGetLocalInfo(dm, &grid));
  PetscCall(SNESGetSolution(snes, &solution));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGlobalToLocal(dm, solution, INSERT_VALUES, local));
  PetscCall(DMDAVecGetArray(dm, local, &u));
  const double h = 2. / (grid.mx - 1);
  for (int j = 1; j < grid.my - 1; ++j)
    for (int i = 1; i < grid.mx - 1; ++i)
    {
      const double inner = times_stiffness(&grid, u, i, j);
      energy += u[j][i] * (inner / 2. - load * h * h);
      if (u[j][i] <= stairs(-1. + i * h) + 1e-12)
      {
        ++n_active;
        force += inner - load * h * h;
      }
    }
  PetscCall(DMDAVecRestoreArray(dm, local, &u));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCall(SNESGetIterationNumber(snes, &steps));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD,
                        "{\"unknowns\": %d, \"active\": %d, \"energy\": %.12g, "
                        "\"force\": %.12g, \"steps\": %d, "
                        "\"processor_seconds\": %.4f}\n",
                        grid.mx * grid.my, n_active, energy, force, steps,
                        seconds));
  return 0;
}

int
main(int argc, char **argv)
{
  DM dm;
  SNES snes;
  SNESConvergedReason reason;
  PetscInt coarsest = 3;
  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-coarsest", &coarsest, NULL));
  const PetscInt n = (1 << coarsest) + 1;
  const double begin = processor_seconds();
  PetscCall(DMDACreate2d(PETSC_COMM_WORLD, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE,
                         DMDA_STENCIL_BOX, n, n, PETSC_DECIDE, PETSC_DECIDE, 1,
                         1, NULL, NULL, &dm));
  PetscCall(DMSetFromOptions(dm));
  PetscCall(DMSetUp(dm));
  PetscCall(DMDASNESSetFunctionLocal(dm, INSERT_VALUES, residual, NULL));
  PetscCall(DMDASNESSetJacobianLocal(dm, jacobian, NULL));
  PetscCall(SNESCreate(PETSC_COMM_WORLD, &snes));
  PetscCall(SNESSetDM(snes, dm));
  PetscCall(SNESSetType(snes, SNESVINEWTONRSLS));
  PetscCall(SNESVISetComputeVariableBounds(snes, bounds));
  PetscCall(SNESSetFromOptions(snes));
  PetscCall(SNESSolve(snes, NULL, NULL));
  const double end = processor_seconds();
  PetscCall(SNESGetConvergedReason(snes, &reason));
  PetscCheck(reason > 0, PETSC_COMM_WORLD, PETSC_ERR_NOT_CONVERGED,
             "SNESVI has not converged: %d", (int)reason);
  PetscCall(report(snes, end - begin));
  PetscCall(SNESDestroy(&snes));
  PetscCall(DMDestroy(&dm));
  return PetscFinalize();
}
