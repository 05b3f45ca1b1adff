// The tables of keys in docs/reference/scene-file.md, made from the records.
#pragma once

#include <string>
#include <vector>

namespace undex::scene {

/// The keys of a table as a Markdown table: key, unit, default, range, meaning. "top": those before the first table; empty
/// where there is none of that name.
std::string key_table(const std::string& name);
/// Every name that key_table knows.
std::vector<std::string> key_table_names();

/// The page with what stands between its marks replaced:
///   <!-- table: scheme -->   ... <!-- end -->   the keys of [scheme]
///   <!-- tables: shape -->   ... <!-- end -->   every shape with what it is and its keys
/// Throws FileError where a mark names no table or has no end; `file` is what the message calls the page.
std::string with_key_tables(const std::string& page, const std::string& file);

}  // namespace undex::scene
