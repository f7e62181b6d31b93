// SPDX-License-Identifier: LGPL-2.1-or-later
/* Sections $NAME to $EndNAME, a node or an element per line. In format 2 each
 * element has the number of its physical group; in format 4 elements and nodes
 * are in blocks of a geometric entity, and entities have groups:
 *
 *   format      block of nodes                block of elements
 *   4.0         tag dim parametric n          tag dim type n
 *   4.1         dim tag parametric n          dim tag type n
 *
 * with the numbers of nodes before their coordinates in 4.1. */
#include "gmsh_file.h"

#include <map>

namespace abut::app
{
  namespace
  {
    /** An element type of gmsh: where the nodes of FileElement are. */
    struct GmshType
    {
      CellShape shape;
      std::vector<unsigned int> order;
    };

    std::vector<unsigned int> in_order(const unsigned int n)
    {
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < n; ++i)
        result.push_back(i);
      return result;
    }

    const std::map<std::int64_t, GmshType> &gmsh_types()
    {
      using Shape = CellShape;
      static const std::map<std::int64_t, GmshType> types = {
          {1, {Shape::line, in_order(2)}},
          {2, {Shape::triangle, in_order(3)}},
          {3, {Shape::quadrilateral, in_order(4)}},
          {4, {Shape::tetrahedron, in_order(4)}},
          {5, {Shape::hexahedron, in_order(8)}},
          {8, {Shape::line, in_order(3)}},
          {9, {Shape::triangle, in_order(6)}},
          {10, {Shape::quadrilateral, in_order(9)}},
          {11, {Shape::tetrahedron, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}}},
          {12, {Shape::hexahedron, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                    11, 13, 9,  16, 18, 19, 17, 10, 12,
                                    14, 15, 20, 21, 22, 23, 24, 25, 26}}}};
      return types;
    }

    /** Why an element cannot be read. */
    std::string refusal(const std::int64_t type)
    {
      if (type == 16 || type == 17)
        return std::string("a serendipity element (")
               + (type == 16 ? "8 nodes" : "20 nodes")
               + ", none inside): write complete elements of degree 2 "
                 "(Mesh.SecondOrderIncomplete = 0) or of degree 1.";
      if (type == 6 || type == 13 || type == 18)
        return "a wedge: cells are tetrahedra or hexahedra.";
      if (type == 7 || type == 14 || type == 19)
        return "a pyramid: cells are tetrahedra or hexahedra.";
      return "which is of a degree above 2 or no line, triangle, "
             "quadrilateral, tetrahedron or hexahedron: set Mesh.ElementOrder "
             "to 1 or 2.";
    }

    class GmshReader
    {
    public:
      explicit GmshReader(const std::filesystem::path &file) : lines(file)
      {
        mesh.repeats_elements = true;
      }

      FileMesh read()
      {
        bool has_nodes = false, has_elements = false;
        while (lines.next())
        {
          const std::string section = lines.text();
          if (section[0] != '$' || section.compare(0, 4, "$End") == 0)
            lines.complain("'" + section
                           + "' is not a section such as $Nodes.");
          if (format == 0 && section != "$MeshFormat" && section != "$Comments")
            lines.complain("'" + section + "' is before $MeshFormat.");
          if (section == "$MeshFormat")
            read_format();
          else if (section == "$PhysicalNames")
            read_names();
          else if (section == "$Entities")
            read_entities();
          else if (section == "$Nodes")
            read_nodes();
          else if (section == "$Elements")
            read_elements();
          else if (section == "$PartitionedEntities")
            lines.complain("the mesh is partitioned: write it as one.");
          else
            while (advance(section) && lines.text() != end_of(section))
              ;
          has_nodes = has_nodes || section == "$Nodes";
          has_elements = has_elements || section == "$Elements";
          if (lines.text() != end_of(section))
            lines.complain("'" + lines.text() + "' where " + end_of(section)
                           + " is expected: " + section
                           + " has more lines than it announces.");
        }
        if (!has_nodes || !has_elements)
          throw MeshFileError(std::string("it ends without ")
                              + (has_nodes ? "$Elements" : "$Nodes")
                              + ": is it cut off?");
        return std::move(mesh);
      }

    private:
      static std::string end_of(const std::string &section)
      {
        return "$End" + section.substr(1);
      }

      bool advance(const std::string &section)
      {
        if (!lines.next())
          throw MeshFileError("it ends within " + section + ": is it cut off?");
        return true;
      }

      /** The numbers of the next line, at least @p least. */
      std::vector<std::int64_t> numbers(const std::string &section,
                                        const std::size_t least)
      {
        const std::vector<std::string> words = content(section, least);
        return lines.wholes(words);
      }

      std::vector<std::string> content(const std::string &section,
                                       const std::size_t least)
      {
        advance(section);
        if (lines.text()[0] == '$')
          lines.complain("'" + lines.text() + "' stands within " + section
                         + ", which announces more lines.");
        std::vector<std::string> words = lines.words();
        if (words.size() < least)
          lines.complain(std::to_string(words.size()) + " of "
                         + std::to_string(least) + " numbers stand in "
                         + section + ".");
        return words;
      }

      void read_format()
      {
        const auto words = content("$MeshFormat", 2);
        const double number = lines.real(words[0]);
        format = number == 4.1                 ? 41
                 : number == 4.                ? 40
                 : number >= 2. && number < 3. ? 20
                                               : 0;
        if (format == 0)
          lines.complain("the format is " + words[0]
                         + "; formats 2.2, 4.0 and 4.1 can be read.");
        if (words[1] != "0")
          lines.complain(
              "the file is a binary one: write text (in gmsh: Mesh.Binary = 0, "
              "or without the option -bin).");
        advance("$MeshFormat");
      }

      void read_names()
      {
        const std::string section = "$PhysicalNames";
        const std::int64_t n = numbers(section, 1)[0];
        for (std::int64_t i = 0; i < n; ++i)
        {
          const auto words = content(section, 3);
          const std::size_t begin = lines.text().find('"'),
                            end = lines.text().rfind('"');
          if (begin == end)
            lines.complain("a physical group has no name in quotes.");
          mesh.sets[set_of(lines.whole(words[0]), lines.whole(words[1]))].name =
              lines.text().substr(begin + 1, end - begin - 1);
        }
        advance(section);
      }

      /** The set of a physical group, made where it is new. */
      std::size_t set_of(const std::int64_t dim, const std::int64_t tag)
      {
        constexpr std::int64_t most = 2147483647;
        if (tag == 0 || tag > most || tag < -most)
          lines.complain("the physical group " + std::to_string(tag)
                         + " is not one of 1 to 2147483647.");
        const std::int64_t id = tag < 0 ? -tag : tag;
        const auto [found, is_new] =
            sets.emplace(std::make_pair(dim, id), mesh.sets.size());
        if (is_new)
        {
          mesh.sets.emplace_back();
          mesh.sets.back().id = static_cast<unsigned int>(id);
          mesh.sets.back().kind = dim == 1   ? "physical curve"
                                  : dim == 2 ? "physical surface"
                                  : dim == 3 ? "physical volume"
                                             : "physical point";
        }
        return found->second;
      }

      void read_entities()
      {
        const std::string section = "$Entities";
        const std::vector<std::int64_t> n = numbers(section, 4);
        for (std::size_t dim = 0; dim < 4; ++dim)
          for (std::int64_t i = 0; i < n[dim]; ++i)
          {
            // Tag, a point or the corners of a box, groups.
            const std::size_t place = dim == 0 && format == 41 ? 4 : 7;
            const auto words = content(section, place + 1);
            const auto n_groups =
                static_cast<std::size_t>(lines.whole(words[place]));
            if (words.size() - place - 1 < n_groups)
              lines.complain("an entity has fewer groups than it announces.");
            auto &list = groups[{std::int64_t(dim), lines.whole(words[0])}];
            for (std::size_t g = 0; g < n_groups; ++g)
              list.push_back(
                  set_of(std::int64_t(dim), lines.whole(words[place + 1 + g])));
          }
        advance(section);
      }

      void add_node(const std::int64_t number,
                    const std::vector<std::string> &words,
                    const std::size_t first, const bool is_parametric)
      {
        if (words.size() < first + 3
            || (words.size() > first + 3 && !is_parametric))
          lines.complain("a node has " + std::to_string(words.size() - first)
                         + " coordinates; it needs 3.");
        mesh.nodes.push_back(
            {number,
             lines.number(),
             {{lines.real(words[first]), lines.real(words[first + 1]),
               lines.real(words[first + 2])}}});
      }

      void read_nodes()
      {
        const std::string section = "$Nodes";
        const std::vector<std::int64_t> head = numbers(section, 1);
        if (format == 20)
          for (std::int64_t i = 0; i < head[0]; ++i)
          {
            const auto words = content(section, 1);
            add_node(lines.whole(words[0]), words, 1, false);
          }
        for (std::int64_t block = 0; format > 20 && block < head[0]; ++block)
        {
          const std::vector<std::int64_t> about = numbers(section, 4);
          std::vector<std::int64_t> tags;
          for (std::int64_t i = 0; format == 41 && i < about[3]; ++i)
            tags.push_back(numbers(section, 1)[0]);
          for (std::int64_t i = 0; i < about[3]; ++i)
          {
            const auto words = content(section, 1);
            add_node(format == 41 ? tags[static_cast<std::size_t>(i)]
                                  : lines.whole(words[0]),
                     words, format == 41 ? 0 : 1, about[2] != 0);
          }
        }
        advance(section);
      }

      /** Add an element of a line whose words from @p first on are nodes. */
      void add_element(const std::int64_t type,
                       const std::vector<std::int64_t> &words,
                       const std::size_t first,
                       const std::vector<std::size_t> &into)
      {
        constexpr std::int64_t point = 15;
        if (type == point)
          return;
        const auto known = gmsh_types().find(type);
        const std::string name = "the element " + std::to_string(words[0]);
        if (known == gmsh_types().end())
          lines.complain(name + " is of type " + std::to_string(type) + ", "
                         + refusal(type));
        const std::vector<unsigned int> &order = known->second.order;
        if (words.size() != first + order.size())
          lines.complain(name + " has " + std::to_string(words.size() - first)
                         + " nodes; its type " + std::to_string(type)
                         + " needs " + std::to_string(order.size()) + ".");
        FileElement element{words[0], lines.number(), known->second.shape, {}};
        for (const unsigned int place : order)
          element.nodes.push_back(words[first + place]);
        for (const std::size_t set : into)
          mesh.sets[set].elements.push_back(element.number);
        mesh.elements.push_back(std::move(element));
      }

      std::int64_t dim_of(const std::int64_t type) const
      {
        const auto known = gmsh_types().find(type);
        return known == gmsh_types().end()
                   ? 0
                   : shape_info(known->second.shape).dim;
      }

      void read_elements()
      {
        const std::string section = "$Elements";
        const std::vector<std::int64_t> head = numbers(section, 1);
        for (std::int64_t i = 0; format == 20 && i < head[0]; ++i)
        {
          const std::vector<std::int64_t> words = numbers(section, 3);
          const auto n_tags = static_cast<std::size_t>(words[2]);
          if (words[2] < 0 || words.size() < 3 + n_tags)
            lines.complain("the element " + std::to_string(words[0])
                           + " has fewer numbers than it announces.");
          std::vector<std::size_t> into;
          if (n_tags > 0 && words[3] != 0)
            into.push_back(set_of(dim_of(words[1]), words[3]));
          add_element(words[1], words, 3 + n_tags, into);
        }
        for (std::int64_t block = 0; format > 20 && block < head[0]; ++block)
        {
          const std::vector<std::int64_t> about = numbers(section, 4);
          const std::int64_t dim = format == 41 ? about[0] : about[1],
                             tag = format == 41 ? about[1] : about[0];
          const std::vector<std::size_t> &into = groups[{dim, tag}];
          for (std::int64_t i = 0; i < about[3]; ++i)
            add_element(about[2], numbers(section, 1), 1, into);
        }
        advance(section);
      }

      FileLines lines;
      int format = 0; ///< 20, 40 or 41
      std::map<std::pair<std::int64_t, std::int64_t>, std::size_t>
          sets; ///< by dimension and tag
      std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>>
          groups; ///< sets of entities by dimension and tag
      FileMesh mesh;
    };
  } // namespace

  FileMesh read_gmsh(const std::filesystem::path &file)
  {
    return GmshReader(file).read();
  }
} // namespace abut::app
