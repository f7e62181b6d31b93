/* Explicit dynamics from C: a bar of 50 elements falls onto a wall (wave speed
 * 30, length 10, velocity 10, height 5). It touches for 2/3 s with force 300
 * and leaves with the velocity with which it came. Ends with 1 if that is not
 * so. */
#include <abut/abut.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum
{
  N = 51
};

/* The force of the elements on the nodes. */
static void
add_elastic(const double *u, double stiffness, double *force)
{
  for (int i = 0; i + 1 < N; ++i)
  {
    const double pull = stiffness * (u[i + 1] - u[i]);
    force[i] += pull;
    force[i + 1] -= pull;
  }
}

int
main(void)
{
  const double h = 0.2, spring = 900 / h, wall = -5, dt = 0.5 * h / 30;
  double u[N] = {0}, v[N], a[N] = {0}, mass[N], place[N], next[N];
  double impulse = 0, momentum = 0;
  for (int i = 0; i < N; ++i)
  {
    v[i] = -10;
    mass[i] = i == 0 || i == N - 1 ? h / 2 : h;
  }
  abut_time_options options = abut_time_defaults();
  options.name = "central difference with projection";
  abut_time_scheme scheme;
  abut_status status = abut_time_scheme_make(&options, &scheme);
  const abut_time_state state = {sizeof(state), &scheme, dt, N, u, v, a, NULL};
  for (int step = 0; step < 600 && status == ABUT_SUCCESS; ++step)
  {
    /* Where the bar would go, and where the wall lets it go. */
    status = abut_time_begin(&state, place);
    memcpy(next, place, sizeof(next));
    next[0] = fmax(place[0], wall);
    impulse += mass[0] * (next[0] - place[0]) / dt;
    if (status == ABUT_SUCCESS)
      status = abut_time_project(&state, place, next);
    /* Forces there give the acceleration. */
    double force[N] = {0};
    add_elastic(next, spring, force);
    for (int i = 0; i < N; ++i)
      force[i] /= mass[i];
    if (status == ABUT_SUCCESS)
      status = abut_time_end(&state, force);
  }
  for (int i = 0; i < N; ++i)
    momentum += mass[i] * v[i];
  printf("%s: impulse %.3f, velocity after it %.3f\n", abut_status_text(status),
         impulse, momentum / 10);
  return status != ABUT_SUCCESS || fabs(impulse / 200 - 1) > 0.02;
}
