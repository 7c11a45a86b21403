// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "FieldFunctions.h"

#include "vtkNew.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyProperty.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTransferFunctionManager.h"

#include <string>
#include <utility>
#include <vector>

namespace
{

const char* const group = "piecewise_functions";
const std::string prefix = "SchlierenField"; // of the functions' names

/// Registers a straight line from 0 to 1 under a new name.
vtkSmartPointer<vtkSMProxy> newFunction(vtkSMSessionProxyManager* manager)
{
  int number = 1;
  const auto name = [&]() { return prefix + std::to_string(number); };
  while (manager->GetProxy(group, (name() + ".PiecewiseFunction").c_str()))
  {
    ++number;
  }
  vtkNew<vtkSMTransferFunctionManager> functions;
  return functions->GetOpacityTransferFunction(name().c_str(), manager);
}

} // namespace

FieldFunctions::FieldFunctions(vtkSMProxyProperty* property)
  : Property(property)
{
}

FieldFunctions::~FieldFunctions() = default;

vtkSMProxyProperty* FieldFunctions::property() const { return this->Property; }

vtkSMProxy* FieldFunctions::at(int row) const
{
  return row >= 0 && row < this->Rows.size() ? this->Rows[row].Get() : nullptr;
}

void FieldFunctions::complete(int count)
{
  this->Rows.resize(count);
  for (vtkSmartPointer<vtkSMProxy>& function : this->Rows)
  {
    if (!function)
    {
      function = newFunction(this->Property->GetParent()->GetSessionProxyManager());
      this->Candidates.append(function);
    }
  }
}

FieldFunctions::Functions FieldFunctions::used() const
{
  Functions functions;
  for (unsigned int i = 0; i < this->Property->GetNumberOfProxies(); ++i)
  {
    functions.append(this->Property->GetProxy(i));
  }
  return functions;
}

void FieldFunctions::read() { this->Rows = this->used(); }

void FieldFunctions::write()
{
  const Functions before = this->used();
  this->Candidates += before;
  if (this->Rows != before)
  {
    const Functions now = this->Rows; // a copy, because setting it reads them back
    std::vector<vtkSMProxy*> proxies(now.begin(), now.end());
    this->Property->SetProxies(static_cast<unsigned int>(proxies.size()), proxies.data());
  }
}

void FieldFunctions::dropUnused()
{
  const Functions now = this->used();
  const Functions candidates = std::exchange(this->Candidates, {});
  for (const vtkSmartPointer<vtkSMProxy>& function : candidates)
  {
    // Keeps functions that copied properties share with another filter.
    if (now.contains(function) || function->GetNumberOfConsumers() > 0)
    {
      this->Candidates.append(function);
      continue;
    }
    vtkSMSessionProxyManager* manager = function->GetSessionProxyManager();
    const char* registered = manager->GetProxyName(group, function);
    const std::string name = registered ? registered : "";
    if (name.rfind(prefix, 0) == 0) // only our own
    {
      manager->UnRegisterProxy(group, name.c_str(), function);
    }
  }
}
