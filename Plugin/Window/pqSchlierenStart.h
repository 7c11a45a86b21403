// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

/// Starts the plugin's automatic functions in ParaView's window.
class pqSchlierenStart : public QObject
{
  Q_OBJECT

public:
  pqSchlierenStart();
  ~pqSchlierenStart() override;

  /// Called when the plugin is loaded and when the program ends.
  void startup();
  void shutdown() {}
};
