#pragma once
/// A TOML file as a flat list of what was written and where: the reader of settings looks up dotted paths such as
/// "numerics.kernel" or "bodies[1].velocity" and never sees TOML. The only place that includes a TOML library is
/// document.cpp.
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace ejecta {

struct Literal;
struct LiteralEntry;
using LiteralList = std::vector<Literal>;
using LiteralTable = std::vector<LiteralEntry>;

/// A value as written, before its meaning is known. Tables come only within lists of other values.
struct Literal {
  std::variant<bool, std::int64_t, double, std::string, LiteralList, LiteralTable> value;
};
struct LiteralEntry {
  std::string key;
  Literal value;
};

/// The value as it would be written in TOML, for messages.
std::string to_text(const Literal& literal);

/// Where something was written: a line of a file, or the command line.
struct Origin {
  std::string text;  ///< "inputs/x.toml:14" or "--set time.end"
  int line = 0;      ///< for sorting; the command line comes last
};

struct Item {
  Literal literal;
  Origin origin;
};

struct Document {
  std::string file;
  std::map<std::string, Item> items;     ///< path -> value
  std::map<std::string, Origin> tables;  ///< path of every table written, also "bodies[0]"

  /// The origin of a value or table, else of the nearest table around it, else the file.
  Origin origin(const std::string& path) const;
  /// Whether anything is written under [name].
  bool holds(const std::string& name) const;
  /// Number of tables written under [[name]].
  std::size_t count(const std::string& name) const;
  /// The keys directly below a path: children("insitu.ranges") -> {"damage", "pressure"}.
  std::vector<std::string> children(const std::string& path) const;
  /// What lies below a path, as a document of its own.
  Document below(const std::string& path) const;
};

/// Path of an element of a list: "bodies[1]".
std::string element_path(const std::string& list, std::size_t k);

/// "bodies[1].profile" -> "bodies.profile", as TOML writes it.
std::string without_numbers(const std::string& path);

/// "bodies[1].velocity" -> "bodies.projectile.velocity", as people call it: what has a name goes by it.
std::string with_names(const Document& document, const std::string& path);

/// Throws InputError if the file is missing or not TOML (with its line).
Document read_document(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Document parse_document(const std::string& text, const std::string& name);

/// A list of things may be written short: of ["a", {key = "b", more = 1}] a text stands for a table that holds it as
/// `key`. Turns such a value into tables. Adds nothing where something else is written, which stays.
void expand_short_list(Document& document, const std::string& path, const std::string& key);

/// Applies "time.end=20us". The value needs no quotes. bodies.projectile.velocity finds the body by its name, and so in
/// every list. Throws InputError if there is no key, no value or no such body.
void apply_override(Document& document, const std::string& assignment);

}  // namespace ejecta
