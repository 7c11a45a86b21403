// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
//
// The emulated device's memory and queues, as strict as CUDA allows:
//   - the host cannot touch memory of the device, nor a kernel what was freed or lies beyond an end;
//   - new memory holds NaN or, of integers, the largest ones;
//   - a launch, an asynchronous copy and a memset do nothing before they are waited for;
//   - a kernel is given no address of the host;
//   - all memory is freed at the end of the program.
// What breaks these rules ends the program.
//
// In the environment: CUDA_VISIBLE_DEVICES empty or -1 hides the device, as with CUDA. EMULATED_DEVICES: how many there
// are, 1 by default; they have their memory in common, but a stream works for one of them only. EMULATED_CAPABILITY: ten
// times their compute capability, 90 by default.
// EMULATED_LAUNCHES names a file that gets the address of each kernel that is launched, as nm prints it.
#include "Threads.h"

#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <set>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(address, bytes) static_cast<void>(0)
#define ASAN_UNPOISON_MEMORY_REGION(address, bytes) static_cast<void>(0)
#endif

namespace emulated
{

namespace
{

std::size_t capacity = defaultCapacity;

std::recursive_mutex mutex;
thread_local cudaError_t lastError = cudaSuccess;
thread_local int currentDevice = 0;
std::map<cudaStream_t, int> deviceOfStream;

cudaError_t failed(cudaError_t error)
{
  lastError = error;
  return error;
}

struct Allocation
{
  char* pages;
  std::size_t bytesOfPages, bytes;
};

struct Work
{
  cudaStream_t stream;
  std::function<void()> run;
};

/// The memory's addresses, which are given out once: what was freed is nobody's for ever.
class Memory
{
public:
  Memory()
    : begin_(static_cast<char*>(
        mmap(nullptr, addresses, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)))
    , next_(begin_ + offset)
  {
    if (begin_ == MAP_FAILED)
    {
      fail("no room for the device's memory");
    }
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory()
  {
    if (!allocations_.empty())
    {
      fail("memory of the device was not freed");
    }
  }

  void* allocate(std::size_t bytes)
  {
    const std::size_t pages = (bytes + page - 1) / page * page;
    if (bytes > free() || pages + page > static_cast<std::size_t>(begin_ + addresses - next_))
    {
      return nullptr;
    }
    // It ends with its last page, as far as alignment allows; the next page is nobody's.
    char* data = next_ + (pages - bytes) / alignment * alignment;
    const Allocation allocation{ next_, pages, bytes };
    next_ += pages + page;
    setAccess(allocation, PROT_READ | PROT_WRITE);
    auto* const words = reinterpret_cast<std::uint32_t*>(allocation.pages);
    std::fill(words, words + pages / sizeof(*words), 0x7fffffffu);
    setAccess(allocation, PROT_NONE);
    ASAN_POISON_MEMORY_REGION(allocation.pages, pages);
    ASAN_UNPOISON_MEMORY_REGION(data, bytes);
    allocations_[data] = allocation;
    allocated_ += bytes;
    return data;
  }

  bool release(void* memory)
  {
    const auto found = allocations_.find(static_cast<char*>(memory));
    if (found == allocations_.end())
    {
      return false;
    }
    const Allocation& freed = found->second;
    mmap(freed.pages, freed.bytesOfPages, PROT_NONE,
      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0);
    allocated_ -= freed.bytes;
    allocations_.erase(found);
    return true;
  }

  std::size_t free() const { return capacity > allocated_ ? capacity - allocated_ : 0; }

  bool isOfDevice(const void* address) const
  {
    return address >= begin_ && address < begin_ + addresses;
  }

  /// Whether all of it is one allocation's.
  bool holds(const void* address, std::size_t bytes) const
  {
    const auto* first = static_cast<const char*>(address);
    auto after = allocations_.upper_bound(const_cast<char*>(first));
    if (after == allocations_.begin())
    {
      return false;
    }
    const auto& [data, allocation] = *std::prev(after);
    return bytes <= allocation.bytes && first <= data + (allocation.bytes - bytes);
  }

  void setAccess(int protection) const
  {
    for (const auto& [data, allocation] : allocations_)
    {
      setAccess(allocation, protection);
    }
  }

private:
  static void setAccess(const Allocation& allocation, int protection)
  {
    mprotect(allocation.pages, allocation.bytesOfPages, protection);
  }

  static constexpr std::size_t addresses = std::size_t{ 1 } << 38;
  static constexpr std::size_t offset =
    addresses / 4; ///< a pointer to before the first one is of the device, too
  static constexpr std::size_t alignment = 16;
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  char* begin_;
  char* next_;
  std::map<char*, Allocation> allocations_;
  std::size_t allocated_ = 0;
};
Memory memory;

/// While it lives, memory can be read and written.
class Access
{
public:
  Access() { memory.setAccess(PROT_READ | PROT_WRITE); }
  Access(const Access&) = delete;
  Access& operator=(const Access&) = delete;
  ~Access() { memory.setAccess(PROT_NONE); }
};

std::deque<Work> queue; ///< of all streams

/// Does what the stream's work waits for, and then that; nothing else.
void finish(cudaStream_t stream)
{
  const auto last = std::find_if(
    queue.rbegin(), queue.rend(), [&](const Work& work) { return work.stream == stream; });
  // Work of the default stream waits for all that came before it, and what comes later waits for it.
  const auto lastOfAll =
    std::find_if(last, queue.rend(), [](const Work& work) { return work.stream == nullptr; });
  auto left = queue.rend() - last;
  auto ofAll = queue.rend() - lastOfAll;
  const Access access;
  for (auto work = queue.begin(); left > 0; --left, --ofAll)
  {
    if (ofAll > 0 || work->stream == stream)
    {
      const std::function<void()> run = std::move(work->run);
      work = queue.erase(work);
      run();
    }
    else
    {
      ++work;
    }
  }
}

void finishAll()
{
  queue.push_back({ nullptr, [] {} }); // which waits for all
  finish(nullptr);
}

bool isRight(const void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind)
{
  const void* device = kind == cudaMemcpyHostToDevice ? to : from;
  const void* host = kind == cudaMemcpyHostToDevice ? from : to;
  return bytes == 0 || (memory.holds(device, bytes) && host != nullptr && !memory.isOfDevice(host));
}

void note(const void* kernel)
{
  static std::set<const void*> noted;
  const char* file = std::getenv("EMULATED_LAUNCHES");
  if (file == nullptr || !noted.insert(kernel).second)
  {
    return;
  }
  Dl_info info{};
  link_map* object = nullptr;
  if (dladdr1(kernel, &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) == 0)
  {
    fail("a kernel is in no file");
  }
  std::FILE* out = std::fopen(file, "a");
  if (out == nullptr)
  {
    fail("EMULATED_LAUNCHES cannot be written");
  }
  std::fprintf(out, "%016zx\n", reinterpret_cast<std::size_t>(kernel) - object->l_addr);
  std::fclose(out);
}

/// The system's kernel looks at the address before it finds that -1 is no way to set a mask.
bool isReadable(std::size_t address)
{
  constexpr std::size_t alignment = 8;
  syscall(SYS_rt_sigprocmask, -1, address / alignment * alignment, nullptr, alignment);
  return errno != EFAULT;
}

} // namespace

void checkArgument(const void* value, std::size_t bytes)
{
  // Structures are looked through for what would be an address. Where programs, heaps and stacks are,
  // other numbers seldom are.
  constexpr std::size_t lowest = 0x500000000000, highest = 0xffffffffffff;
  for (std::size_t at = 0; at + sizeof(std::size_t) <= bytes; at += sizeof(std::size_t))
  {
    std::size_t word = 0;
    std::memcpy(&word, static_cast<const char*>(value) + at, sizeof(word));
    if (word >= lowest && word <= highest && !memory.isOfDevice(reinterpret_cast<void*>(word)) &&
      isReadable(word))
    {
      std::fprintf(stderr, "Emulated CUDA device: byte %zu of an argument of %zu bytes: %#zx\n", at,
        bytes, word);
      fail("a kernel is given an address of the host");
    }
  }
}

void setCapacity(std::size_t bytes)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  capacity = bytes;
}

cudaError_t enqueue(Launch launch, cudaStream_t stream)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  const dim3& threads = launch.threads;
  const dim3& blocks = launch.blocks;
  const auto count = [](const dim3& of) { return std::uint64_t{ of.x } * of.y * of.z; };
  if (count(threads) == 0 || count(threads) > 1024 || threads.z > 64 || count(blocks) == 0 ||
    count(blocks) > 0x7fffffff || blocks.y > 65535 || blocks.z > 65535 ||
    launch.sharedBytes > 48 << 10)
  {
    return failed(cudaErrorInvalidConfiguration);
  }
  if (stream != nullptr && deviceOfStream.at(stream) != currentDevice)
  {
    return failed(cudaErrorInvalidResourceHandle);
  }
  note(launch.kernel);
  queue.push_back({ stream, [launch = std::move(launch)] { run(launch); } });
  return cudaSuccess;
}

cudaError_t allocate(void** data, std::size_t bytes)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  *data = bytes > 0 ? memory.allocate(bytes) : nullptr;
  return bytes > 0 && *data == nullptr ? failed(cudaErrorMemoryAllocation) : cudaSuccess;
}

} // namespace emulated

using namespace emulated;

cudaError_t cudaGetDeviceCount(int* count)
{
  const char* visible = std::getenv("CUDA_VISIBLE_DEVICES");
  const bool isHidden =
    visible != nullptr && (std::strcmp(visible, "") == 0 || std::strcmp(visible, "-1") == 0);
  const char* devices = std::getenv("EMULATED_DEVICES");
  *count = isHidden ? 0 : devices != nullptr ? std::atoi(devices) : 1;
  return isHidden ? failed(cudaErrorNoDevice) : cudaSuccess;
}

cudaError_t cudaGetDevice(int* device)
{
  *device = currentDevice;
  return cudaSuccess;
}

cudaError_t cudaSetDevice(int device)
{
  int count = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  if (error != cudaSuccess || device < 0 || device >= count)
  {
    return error != cudaSuccess ? error : failed(cudaErrorInvalidDevice);
  }
  currentDevice = device;
  return cudaSuccess;
}

cudaError_t cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int)
{
  const char* capability = std::getenv("EMULATED_CAPABILITY");
  const int both = capability != nullptr ? std::atoi(capability) : 90;
  *value = attribute == cudaDevAttrComputeCapabilityMajor ? both / 10 : both % 10;
  return cudaSuccess;
}

cudaError_t cudaGetLastError()
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  return std::exchange(lastError, cudaSuccess);
}

const char* cudaGetErrorString(cudaError_t error)
{
  switch (error)
  {
    case cudaSuccess:
      return "no error";
    case cudaErrorInvalidValue:
      return "invalid argument";
    case cudaErrorMemoryAllocation:
      return "out of memory";
    case cudaErrorInvalidConfiguration:
      return "invalid configuration argument";
    case cudaErrorInvalidDevice:
      return "invalid device ordinal";
    case cudaErrorInvalidResourceHandle:
      return "invalid resource handle";
    case cudaErrorNotReady:
      return "device not ready";
    default:
      return "no CUDA-capable device is detected";
  }
}

cudaError_t cudaMemGetInfo(std::size_t* free, std::size_t* total)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  *free = memory.free();
  *total = capacity;
  return cudaSuccess;
}

cudaError_t cudaFree(void* data)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  finishAll();
  return data == nullptr || memory.release(data) ? cudaSuccess : failed(cudaErrorInvalidValue);
}

cudaError_t cudaMemcpyAsync(
  void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  if (!isRight(to, from, bytes, kind))
  {
    return failed(cudaErrorInvalidValue);
  }
  if (bytes > 0)
  {
    queue.push_back({ stream, [=] { std::memcpy(to, from, bytes); } });
  }
  return cudaSuccess;
}

cudaError_t cudaMemcpy(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  const cudaError_t error = cudaMemcpyAsync(to, from, bytes, kind, nullptr);
  finish(nullptr);
  return error;
}

cudaError_t cudaMemset(void* to, int value, std::size_t bytes)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  if (!memory.holds(to, bytes))
  {
    return failed(cudaErrorInvalidValue);
  }
  queue.push_back({ nullptr, [=] { std::memset(to, value, bytes); } });
  return cudaSuccess;
}

cudaError_t cudaStreamCreate(cudaStream_t* stream)
{
  static std::uintptr_t streams = 0;
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  *stream = reinterpret_cast<cudaStream_t>(++streams);
  deviceOfStream[*stream] = currentDevice;
  return cudaSuccess;
}

cudaError_t cudaStreamSynchronize(cudaStream_t stream)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  finish(stream);
  return cudaSuccess;
}

/// CUDA, too, does not wait for the stream's work.
cudaError_t cudaStreamDestroy(cudaStream_t) { return cudaSuccess; }

struct CUevent_st
{
  std::shared_ptr<std::chrono::steady_clock::time_point> happened; ///< zero before
};

cudaError_t cudaEventCreate(cudaEvent_t* event)
{
  *event = new CUevent_st{};
  return cudaSuccess;
}

cudaError_t cudaEventRecord(cudaEvent_t event, cudaStream_t stream)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  event->happened = std::make_shared<std::chrono::steady_clock::time_point>();
  queue.push_back(
    { stream, [happened = event->happened] { *happened = std::chrono::steady_clock::now(); } });
  return cudaSuccess;
}

cudaError_t cudaEventElapsedTime(float* milliseconds, cudaEvent_t begin, cudaEvent_t end)
{
  const std::lock_guard<std::recursive_mutex> lock(mutex);
  if (!begin->happened || !end->happened)
  {
    return failed(cudaErrorInvalidValue);
  }
  const std::chrono::steady_clock::time_point none{};
  if (*begin->happened == none || *end->happened == none)
  {
    return failed(cudaErrorNotReady);
  }
  *milliseconds =
    std::chrono::duration<float, std::milli>(*end->happened - *begin->happened).count();
  return cudaSuccess;
}

cudaError_t cudaEventDestroy(cudaEvent_t event)
{
  delete event;
  return cudaSuccess;
}
