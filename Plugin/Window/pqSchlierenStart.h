// SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QObject>

/// Sets up what the plugin does in ParaView's window without being called.
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
