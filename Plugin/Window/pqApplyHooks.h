// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqImageRefiner.h"

#include <QObject>

#include <optional>

class pqProxy;

/// Extends Apply: ParaView's own updates are short, images are refined afterwards, and a new
/// Schlieren filter gets a view of its own.
class pqApplyHooks : public QObject
{
  Q_OBJECT

public:
  explicit pqApplyHooks(QObject* parent);

  /// Connects to the window, which must exist. Further calls do nothing.
  void setUp();

private:
  void beforeOne(pqProxy* proxy);
  void beforeAll();
  void after();

  bool IsSetUp = false;
  std::optional<pqImageRefiner::ShortUpdates> Shortly;
};
