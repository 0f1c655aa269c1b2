/// \file
/// How this process keeps its heap.
#pragma once

namespace seeker::app {

/// Has the allocator give large blocks back as soon as they are freed, and share few heaps among all threads. A server
/// that runs for weeks allocates pictures and maps of many sizes; by default the allocator takes ever larger blocks
/// into the heap, where what lives long lands between them, and every thread gets a heap of its own: the process grows
/// although what it uses does not. Call it once, before the first thread.
void keep_heap_compact();

}  // namespace seeker::app
