// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_HEIGHT_MAP_H
#define ABUT_APP_HEIGHT_MAP_H

/** @file
 * Obstacles and other functions given as grey-scale images.
 */

#include <deal.II/base/function.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::app
{
  /** A grey-scale image of the Netpbm formats P2 (text) and P5 (binary), with
   * 8 or 16 bits per pixel. */
  struct GreyImage
  {
    std::size_t width = 0;
    std::size_t height = 0;
    /** Grey values from 0 (black) to 1 (the file's largest value), row after
     * row from the top as in the file. */
    std::vector<double> pixels;
  };

  /** Read a PGM file; @p parameter is named in the InputError that says what
   * is wrong with it (missing, another format, bad header, truncated). */
  GreyImage read_pgm(const std::filesystem::path &file,
                     const std::string &parameter);

  /** Where an image lies and what its grey values mean. */
  struct HeightMapParameters
  {
    std::string file; /**< empty: there is none */
    dealii::Point<2> lower;
    dealii::Point<2> upper;
    double lowest = 0;
    double highest = 1;
    /** Full name of the parameter `Height map`, for messages. */
    std::string parameter;

    /** Declare `Height map`, `Height map lower corner`, `Height map upper
     * corner`, `Height map lowest` and `Height map highest` in the present
     * section of @p prm. */
    static void declare(dealii::ParameterHandler &prm);

    /** Read them; @p section is the present section's full name, for messages.
     * Throws InputError for corners in the wrong order. */
    void parse(dealii::ParameterHandler &prm, const std::string &section);
  };

  /** Height z(x, y) from an image by bilinear interpolation. The centres of
   * the image's outermost pixels lie on the rectangle's sides, its top row at
   * the upper y; outside the rectangle the nearest value of the rim holds.
   * Independent of the third coordinate and of time. */
  template <int dim> class HeightMap : public dealii::Function<dim>
  {
  public:
    /** @param file the image, already resolved against the scene's folder */
    HeightMap(const HeightMapParameters &parameters,
              const std::filesystem::path &file);

    double value(const dealii::Point<dim> &point,
                 unsigned int component = 0) const override;

  private:
    GreyImage image;
    dealii::Point<2> lower;
    dealii::Point<2> upper;
    double lowest;
    double highest;
  };
} // namespace abut::app

#endif
