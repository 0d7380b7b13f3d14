#pragma once

#include <string>

namespace tubesight::drivers {

/// What is being written and has not its name yet: files and folders that must not stay behind
/// when the program is told to end in the midst of it.
///
/// One list for the program, as a signal ends all of it. From any thread; waits while another
/// thread changes the list.

/// Adds a path. What is relative counts from the working folder of now.
void note_unfinished(const std::string& path);

/// Takes it off: it is in its place, or gone. Passed over when it is not noted.
void forget_unfinished(const std::string& path);

/// Removes all that is noted, and keeps the list from then on: whoever would note, forget or
/// rename waits for ever. For a program that ends itself in the next moment, so that nothing begins
/// behind it. Does nothing about what cannot be removed.
void remove_unfinished_for_good();

/// Gives what is noted its name and forgets it, in one step. False and errno where the system
/// refuses; it is noted then as before.
[[nodiscard]] bool rename_unfinished(const std::string& path, const std::string& target);

/// Opens a new file beside `target` to write it under a name of its own, `target.N.part`, and notes
/// it. One of that name that a program left behind is removed first: nobody holds its lock, which
/// the system takes from a program that ends, however it ends. -1 and errno where it cannot be.
[[nodiscard]] int open_unfinished_beside(const std::string& target, std::string& path);

/// The same of a folder, `folder/NAME.N.part`, that is empty and noted. The descriptor holds its
/// lock and is the caller's to close, behind the folder's removal.
[[nodiscard]] int make_unfinished_folder(const std::string& name, std::string& path);

}  // namespace tubesight::drivers
