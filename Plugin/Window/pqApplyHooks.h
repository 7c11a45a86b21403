// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pqImageRefiner.h"

#include <QObject>

#include <optional>

class pqProxy;

/// What the plugin does when the user presses Apply: ParaView's own updates are short, images are refined
/// afterwards, and a new Schlieren filter gets a view of its own.
class pqApplyHooks : public QObject
{
  Q_OBJECT

public:
  explicit pqApplyHooks(QObject* parent);

  /// Sets them up around what ParaView does; to be called when its window is there. Once is enough.
  void setUp();

private:
  void beforeOne(pqProxy* proxy);
  void beforeAll();
  void after();

  bool IsSetUp = false;
  std::optional<pqImageRefiner::ShortUpdates> Shortly;
};
