// SPDX-License-Identifier: LGPL-2.1-or-later
/* A keyword line, *KEYWORD, NAME=VALUE, FLAG, is followed by its data lines; a
 * line that ends with a comma goes on in the next. Lines that begin with ** are
 * comments. Words have no case.
 *
 * Sets and surfaces of a part and of the assembly are apart. Where one name is
 * in both, that of the part is INSTANCE.NAME. Nodes and elements of the
 * assembly itself, such as reference points, are not those of the mesh. */
#include "abaqus_file.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

namespace abut::app
{
  namespace
  {
    std::string upper(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      return text;
    }

    /** An element type: 0 nodes if it is not supported. */
    struct AbaqusType
    {
      CellShape shape;
      std::size_t n_nodes;
    };

    /** Letters at the beginning of the types of solid elements, and of those
     * that mark facets: gmsh writes CPS for surfaces and T3D for lines. */
    const char *const solids[] = {"C3D",   "CPS", "CPE", "CAX",
                                  "SFM3D", "T3D", "T2D"};

    /** Family and number of nodes of a type such as C3D10M. */
    std::pair<std::string, int> parts_of(const std::string &type)
    {
      for (const std::string family : solids)
        if (type.compare(0, family.size(), family) == 0)
          return {family, std::atoi(type.c_str() + family.size())};
      return {"", 0};
    }

    /** The element type, or the reason why it is not supported. */
    AbaqusType element_type(const std::string &type, std::string &reason)
    {
      const auto [family, n] = parts_of(type);
      const bool is_line = family == "T3D" || family == "T2D";
      const bool is_plane = !is_line && family != "C3D" && !family.empty();
      if (is_line && (n == 2 || n == 3))
        return {CellShape::line, std::size_t(n)};
      if (is_plane && (n == 3 || n == 6))
        return {CellShape::triangle, std::size_t(n)};
      if (is_plane && n == 4)
        return {CellShape::quadrilateral, 4};
      if (family == "C3D" && (n == 4 || n == 10))
        return {CellShape::tetrahedron, std::size_t(n)};
      if (family == "C3D" && n == 8)
        return {CellShape::hexahedron, 8};
      if ((family == "C3D" && (n == 20 || n == 27)) || (is_plane && n == 8))
        reason = "is a serendipity element (no inner nodes), which is not "
                 "supported: write elements of degree 1, or tetrahedra or "
                 "triangles of degree 2.";
      else if (family == "C3D" && (n == 6 || n == 15))
        reason = "is a wedge: cells are tetrahedra or hexahedra.";
      else if (family == "C3D" && (n == 5 || n == 13))
        reason = "is a pyramid: cells are tetrahedra or hexahedra.";
      else
        reason =
            "is not one of C3D4, C3D8, C3D10, and CPS, CPE and CAX with 3, "
            "4 or 6.";
      return {CellShape::line, 0};
    }

    struct Keyword
    {
      std::string name;                         ///< upper case, without *
      std::map<std::string, std::string> words; ///< upper case to value

      bool has(const std::string &word) const
      {
        return words.count(word) > 0;
      }
      std::string get(const std::string &word) const
      {
        const auto found = words.find(word);
        return found == words.end() ? "" : found->second;
      }
    };

    /** Keywords whose omission would leave another mesh. */
    const char *const mesh_makers[] = {
        "INCLUDE", "NGEN",   "NFILL",     "NCOPY",  "NMAP",
        "ELGEN",   "ELCOPY", "PARAMETER", "SYSTEM", "IMPORT"};

    class AbaqusReader
    {
    public:
      AbaqusReader(const std::filesystem::path &file, const std::string &wanted)
          : lines(file), wanted(upper(wanted))
      {
      }

      FileMesh read()
      {
        find_parts();
        while (has_line || next_line())
        {
          has_line = false;
          if (lines.text()[0] != '*')
            continue; // data of a keyword that is passed over
          read_keyword();
          handle();
        }
        if (mesh.nodes.empty() || mesh.elements.empty())
          throw MeshFileError(std::string("it has no ")
                              + (mesh.nodes.empty() ? "*NODE" : "*ELEMENT")
                              + " with a line of data.");
        for (FileNode &node : mesh.nodes)
          for (unsigned int d = 0; d < 3; ++d)
            node.place[d] += translation[d];
        mesh.part = part;
        name_sets();
        return std::move(mesh);
      }

    private:
      enum class Scope
      {
        whole, ///< a file without parts
        part,
        assembly,
        other_part ///< not read
      };

      enum class Kind
      {
        nodes,
        elements,
        surface
      };

      /** Scope, kind and name in upper case. */
      using Key = std::tuple<Scope, Kind, std::string>;

      bool next_line()
      {
        while (lines.next())
          if (lines.text().compare(0, 2, "**") != 0)
            return true;
        return false;
      }

      /** The next data line of the present keyword. */
      bool next_data()
      {
        has_line = next_line();
        if (!has_line || lines.text()[0] == '*')
          return false;
        has_line = false;
        return true;
      }

      void read_keyword()
      {
        std::string text = lines.text().substr(1);
        while (!text.empty() && text.back() == ',' && next_line())
          text += lines.text();
        keyword = {};
        for (std::size_t begin = 0, i = 0; begin <= text.size(); ++i)
        {
          const std::size_t end = std::min(text.find(',', begin), text.size());
          add_word(text.substr(begin, end - begin), i == 0);
          begin = end + 1;
        }
      }

      static std::string stripped(const std::string &text, const char *what)
      {
        const std::size_t first = text.find_first_not_of(what),
                          last = text.find_last_not_of(what);
        return first == std::string::npos
                   ? ""
                   : text.substr(first, last - first + 1);
      }

      void add_word(const std::string &text, const bool is_first)
      {
        const std::string word = stripped(text, " \t\r");
        const std::size_t equals = word.find('=');
        if (is_first)
          for (const char c : upper(word))
          {
            if (c != ' ' || keyword.name.back() != ' ')
              keyword.name += c;
          }
        else if (equals != std::string::npos)
          keyword.words[upper(stripped(word.substr(0, equals), " \t"))] =
              stripped(word.substr(equals + 1), " \t\"");
        else if (!word.empty())
          keyword.words[upper(word)] = "";
      }

      void handle()
      {
        const std::string &name = keyword.name;
        for (const std::string maker : mesh_makers)
          if (name == maker)
            lines.complain("*" + name
                           + " changes the mesh and is not supported: write "
                             "all nodes and elements into one file.");
        if (name == "PART")
          begin_part();
        else if (name == "INSTANCE")
          begin_instance();
        else if (name == "ASSEMBLY" || name == "END INSTANCE")
          scope = Scope::assembly;
        else if (name == "END PART" || name == "END ASSEMBLY")
          scope = Scope::whole;
        else if (scope == Scope::other_part)
          return;
        else if (name == "NODE" && scope != Scope::assembly)
          read_nodes();
        else if (name == "ELEMENT" && scope != Scope::assembly)
          read_elements();
        else if (name == "NSET" || name == "ELSET")
          read_set(name == "NSET" ? Kind::nodes : Kind::elements);
        else if (name == "SURFACE")
          read_surface();
      }

      void find_parts()
      {
        while (next_line())
          if (upper(lines.text().substr(0, 5)) == "*PART")
          {
            read_keyword();
            if (keyword.name == "PART")
              parts.push_back(keyword.get("NAME"));
          }
        lines.rewind();
        std::string names;
        for (const std::string &each : parts)
        {
          names += (names.empty() ? "'" : "', '") + each;
          if (parts.size() == 1 || (part.empty() && upper(each) == wanted))
            part = each;
        }
        if (parts.size() > 1 && part.empty())
          throw MeshFileError("it has the parts " + names
                              + "': set Mesh/Part to one of them.");
      }

      void begin_part()
      {
        scope = upper(keyword.get("NAME")) == upper(part) ? Scope::part
                                                          : Scope::other_part;
      }

      void begin_instance()
      {
        const std::string given = keyword.get("NAME");
        if (upper(keyword.get("PART")) != upper(part))
        {
          scope = Scope::other_part;
          return;
        }
        if (!instance.empty())
          lines.complain("the instance '" + given + "' follows '" + instance
                         + "': a part must have one, since a body has one "
                           "mesh.");
        instance = given;
        scope = Scope::part;
        for (unsigned int line = 0; next_data(); ++line)
        {
          const std::vector<std::string> words = lines.words(',');
          if (line > 0 || words.size() > 3)
            lines.complain("the instance '" + given
                           + "' is rotated: give it no rotation here, and set "
                             "Mesh/Rotate instead.");
          for (std::size_t d = 0; d < words.size(); ++d)
            translation[d] = words[d].empty() ? 0. : lines.real(words[d]);
        }
      }

      void refuse_other_file(const char *word) const
      {
        if (keyword.has(word))
          lines.complain("*" + keyword.name + " with " + word + "="
                         + keyword.get(word)
                         + " is not supported: write all nodes and elements "
                           "into one file, in Cartesian coordinates.");
      }

      void read_nodes()
      {
        refuse_other_file("INPUT");
        if (upper(keyword.get("SYSTEM")) != "R")
          refuse_other_file("SYSTEM");
        const std::string set = keyword.get("NSET");
        while (next_data())
        {
          const std::vector<std::string> words = lines.words(',');
          if (words.size() < 2 || words.size() > 4)
            lines.complain("a node has " + std::to_string(words.size() - 1)
                           + " coordinates"
                           + (words.size() > 4 ? ": a decimal comma?" : "."));
          FileNode node{lines.whole(words[0]), lines.number(), {}};
          for (std::size_t d = 1; d < words.size(); ++d)
            node.place[d - 1] = words[d].empty() ? 0. : lines.real(words[d]);
          mesh.nodes.push_back(node);
          if (!set.empty())
            set_of(Kind::nodes, set).nodes.push_back(node.number);
        }
      }

      void read_elements()
      {
        refuse_other_file("INPUT");
        refuse_other_file("FILE");
        const std::string name = upper(keyword.get("TYPE"));
        std::string reason;
        const AbaqusType type = element_type(name, reason);
        if (!reason.empty())
          lines.complain("the element type "
                         + (name.empty() ? "of *ELEMENT" : name) + " "
                         + reason);
        const std::string set = keyword.get("ELSET");
        while (next_data())
        {
          const std::size_t line = lines.number();
          std::vector<std::string> words = lines.words(',');
          // A line that ends with a comma goes on.
          while (words.size() < type.n_nodes + 1 && lines.text().back() == ','
                 && next_data())
            for (const std::string &word : lines.words(','))
              words.push_back(word);
          if (has_line || words.size() != type.n_nodes + 1)
            throw MeshFileError("in line " + std::to_string(line)
                                + ", the element " + words[0] + " has "
                                + std::to_string(words.size() - 1)
                                + " nodes; its type " + name + " needs "
                                + std::to_string(type.n_nodes) + ".");
          FileElement element{lines.whole(words[0]), line, type.shape,
                              lines.wholes(words, 1)};
          if (type.shape == CellShape::line && type.n_nodes == 3)
            std::swap(element.nodes[1], element.nodes[2]);
          index.emplace(element.number, mesh.elements.size());
          mesh.elements.push_back(std::move(element));
          if (!set.empty())
            set_of(Kind::elements, set)
                .elements.push_back(mesh.elements.back().number);
        }
      }

      /** A set of the present scope, made where it is new. */
      FileSet &set_of(const Kind kind, const std::string &name)
      {
        const auto [found, is_new] =
            sets.emplace(Key{scope, kind, upper(name)}, mesh.sets.size());
        if (is_new)
        {
          mesh.sets.emplace_back();
          mesh.sets.back().name = name;
          mesh.sets.back().kind = kind == Kind::nodes      ? "node set"
                                  : kind == Kind::elements ? "element set"
                                                           : "surface";
        }
        return mesh.sets[found->second];
      }

      /** Whether a word is INSTANCE.NAME of an instance that is not read. */
      bool is_of_other_part(const std::string &word) const
      {
        return scope == Scope::assembly && parts.size() > 1
               && word.find('.') != std::string::npos
               && upper(word.substr(0, instance.size() + 1))
                      != upper(instance) + ".";
      }

      /** A set that a data line names; those of the part are also seen from the
       * assembly, as NAME or INSTANCE.NAME. */
      FileSet find_set(const Kind kind, const std::string &word) const
      {
        std::string name = upper(stripped(word, "\""));
        const std::string prefix = upper(instance) + ".";
        auto found = sets.find(Key{scope, kind, name});
        if (name.compare(0, prefix.size(), prefix) == 0)
          name.erase(0, prefix.size());
        if (found == sets.end())
          found = sets.find(Key{Scope::part, kind, name});
        if (found == sets.end())
          lines.complain(
              "'" + word + "' is neither a number nor the name of "
              + (kind == Kind::nodes ? "a node set." : "an element set."));
        return mesh.sets[found->second];
      }

      static bool is_number(const std::string &word)
      {
        return !word.empty()
               && std::isdigit(static_cast<unsigned char>(word[0])) != 0;
      }

      /** Whether numbers in a set are not those of another instance or of the
       * assembly's own reference points. */
      bool are_of_mesh() const
      {
        return scope != Scope::assembly
               || (keyword.has("INSTANCE")
                   && upper(keyword.get("INSTANCE")) == upper(instance));
      }

      void read_set(const Kind kind)
      {
        const std::string word = kind == Kind::nodes ? "NSET" : "ELSET";
        const std::string name = keyword.get(word);
        if (name.empty())
          lines.complain("*" + word + " has no name (" + word + "=...).");
        const bool ranges = keyword.has("GENERATE");
        if (keyword.has("INTERNAL"))
          internal.insert({scope, kind, upper(name)});
        std::vector<std::int64_t> numbers;
        if (kind == Kind::nodes && keyword.has("ELSET"))
          for (const std::int64_t element :
               find_set(Kind::elements, keyword.get("ELSET")).elements)
          {
            const auto found = index.find(element);
            if (found == index.end())
              lines.complain("the element set '" + keyword.get("ELSET")
                             + "' has the element " + std::to_string(element)
                             + ", which does not exist.");
            for (const std::int64_t node : mesh.elements[found->second].nodes)
              numbers.push_back(node);
          }
        while (next_data())
        {
          const std::vector<std::string> words = lines.words(',');
          if (ranges && are_of_mesh())
            add_range(words, numbers);
          for (std::size_t i = 0; i < words.size() && !ranges; ++i)
            if (is_number(words[i]))
            {
              if (are_of_mesh())
                numbers.push_back(lines.whole(words[i]));
            }
            else if (!words[i].empty() && !is_of_other_part(words[i]))
            {
              const FileSet other = find_set(kind, words[i]);
              const auto &its =
                  kind == Kind::nodes ? other.nodes : other.elements;
              numbers.insert(numbers.end(), its.begin(), its.end());
            }
        }
        FileSet &set = set_of(kind, name);
        set.has_ranges = set.has_ranges || ranges;
        auto &its = kind == Kind::nodes ? set.nodes : set.elements;
        its.insert(its.end(), numbers.begin(), numbers.end());
      }

      void add_range(const std::vector<std::string> &words,
                     std::vector<std::int64_t> &numbers) const
      {
        constexpr std::int64_t most = 100000000;
        const std::vector<std::int64_t> range = lines.wholes(words);
        const std::int64_t step = range.size() > 2 ? range[2] : 1;
        if (range.size() < 2 || range.size() > 3 || step < 1
            || range[1] < range[0] || (range[1] - range[0]) / step > most)
          lines.complain("'" + lines.text()
                         + "' is not a range: first, last, step.");
        for (std::int64_t i = range[0]; i <= range[1]; i += step)
          numbers.push_back(i);
      }

      void read_surface()
      {
        const std::string name = keyword.get("NAME"),
                          type = upper(keyword.get("TYPE"));
        if (keyword.has("COMBINE") || keyword.has("CROP"))
          lines.complain("*SURFACE made of others (COMBINE, CROP) is not "
                         "supported.");
        const bool of_nodes = type == "NODE";
        if (!of_nodes && !type.empty() && type != "ELEMENT")
          return; // a rigid surface by formula
        if (keyword.has("INTERNAL"))
          internal.insert({scope, Kind::surface, upper(name)});
        while (next_data())
        {
          const std::vector<std::string> words = lines.words(',');
          FileSet members;
          auto &its = of_nodes ? members.nodes : members.elements;
          if (is_of_other_part(words[0]))
            continue;
          if (is_number(words[0]))
            its.push_back(lines.whole(words[0]));
          else
            members =
                find_set(of_nodes ? Kind::nodes : Kind::elements, words[0]);
          FileSet &set = set_of(Kind::surface, name);
          set.has_ranges = set.has_ranges || members.has_ranges;
          if (of_nodes)
            set.nodes.insert(set.nodes.end(), members.nodes.begin(),
                             members.nodes.end());
          else
            for (const std::int64_t element : members.elements)
              set.sides.emplace_back(element, side_of(words));
        }
      }

      unsigned int side_of(const std::vector<std::string> &words) const
      {
        if (words.size() < 2 || words[1].empty())
          return every_side;
        const std::string word = upper(words[1]);
        if (word.size() != 2 || word[0] != 'S' || word[1] < '1'
            || word[1] > '6')
          lines.complain("'" + words[1]
                         + "' is not a face, which are S1 to S6.");
        return static_cast<unsigned int>(word[1] - '1');
      }

      void name_sets()
      {
        for (const auto &[key, set] : sets)
        {
          const std::string &name = std::get<2>(key);
          if (internal.count(key) > 0)
            mesh.sets[set] = {};
          for (const Kind kind : {Kind::nodes, Kind::elements, Kind::surface})
            if (std::get<0>(key) == Scope::part
                && sets.count(Key{Scope::assembly, kind, name}) > 0)
              mesh.sets[set].name = (instance.empty() ? part : instance) + "."
                                    + mesh.sets[set].name;
        }
      }

      FileLines lines;
      bool has_line = false; ///< a keyword that has been read already
      Keyword keyword;
      Scope scope = Scope::whole;
      const std::string wanted; ///< name of a part or set
      std::vector<std::string> parts;
      std::string part, instance; ///< that are read
      std::array<double, 3> translation{};
      std::map<Key, std::size_t> sets;
      std::set<Key> internal; ///< sets that programs made up
      std::unordered_map<std::int64_t, std::size_t> index; ///< of elements
      FileMesh mesh;
    };
  } // namespace

  FileMesh read_abaqus(const std::filesystem::path &file,
                       const std::string &part)
  {
    return AbaqusReader(file, part).read();
  }
} // namespace abut::app
